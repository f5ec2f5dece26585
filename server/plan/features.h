#pragma once

#include <string>
#include <vector>

#include "common/problem.h"
#include "common/scene/features.h"
#include "metamer/v1/plan.pb.h"
#include "server/scene/render_scene.h"

namespace metamer {

/// A feature that a scene or its settings need, and where.
struct Need {
  Feature feature;
  /// "material[2].transmission", of the first that needs it; empty: no field of a scene.
  std::string field;
  std::size_t count = 1;  ///< Of the materials, objects or lights that need it.
};

/// What a scene, compiled, and its settings (defaults filled in) need beyond what every renderer
/// and every method has, each feature once.
std::vector<Need> features_of(const RenderScene& scene, const v1::Settings& settings);
/// Factors are kept for relighting: a job asks for it, not a scene.
Need need_of_factors();

/// What a renderer or a method has.
struct Supported {
  std::string by;  ///< "gl backend"
  Features features;
};

/// Adds a notice for each need that is not supported and without which there is a picture all the
/// same.
void notice_unsupported(const std::vector<Need>& needs, const Supported& supported, v1::Plan& plan);

/// A problem for each need that is not supported and without which there is no sense in a picture.
std::vector<Problem> refuse_unsupported(const std::vector<Need>& needs, const Supported& supported);

}  // namespace metamer
