#pragma once

#include <Eigen/Core>

#include "common/spectral/cie.h"
#include "server/scene/render_scene.h"

namespace metamer {

/// The light that a scene may show, for a fit to learn from: each distinct emission by itself, over
/// each surface, and over that in a mirror; at every nm from 360 to 830. Lights have luminance 1:
/// how bright a pixel will be, nobody knows yet. Lights that the observer does not see are left
/// out.
struct TrainingSet {
  Eigen::MatrixXd spectra;  ///< A column each; the first `whites` are the lights by themselves.
  Eigen::MatrixXd xyz;      ///< Their X Y Z, three rows.
  /// What an error of 1 in X, Y or Z counts, about in ΔE; three rows. The three classes of light
  /// (by itself, over a surface, in a mirror) count alike, mirrors twice, however many there are.
  Eigen::MatrixXd weights;
  Eigen::Index whites;
  Eigen::VectorXd sensitivity;  ///< (x̄ + ȳ + z̄) Δλ at each row.
};

/// Of more than `most` columns, surfaces are left out evenly: first of those in mirrors.
TrainingSet make_training_set(const RenderScene& scene, const Observer& observer,
                              Eigen::Index most = 4096);

}  // namespace metamer
