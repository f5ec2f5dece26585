#pragma once

#include <vector>

#include "common/color/xyz.h"
#include "common/spectral/cie.h"
#include "common/transport/factor_values.h"
#include "server/scene/render_scene.h"
#include "server/transport/gather.h"

namespace metamer {

/// What every method is measured against: the integral from 360 to 830 nm over all that the scene's
/// spectra say, between whole nanometres too (cells_of), in f64. Not for rendering: it takes its
/// time. Belongs to one thread.
class Reference {
 public:
  /// `scene` must outlive it.
  Reference(const RenderScene& scene, const Observer& observer);

  /// Where it takes its sums, with their weights: in each cell every spectrum of the scene is a
  /// line.
  static Wavelengths cells(const RenderScene& scene, const Observer& observer);

  /// The light of one pixel, `scale` times the sums of `gather`.
  Xyz resolve(const Gather& gather, double scale);

  /// The white of colour differences: a perfect white that faces the dominant light, the first one
  /// that the observer sees at all. Equal energy at Y = 1 where there is none, or one without X, Y
  /// or Z.
  const Xyz& white() const { return white_; }

 private:
  Reference(const RenderScene& scene, const Observer& observer, const Wavelengths& wavelengths);

  using Values = std::vector<double>;
  struct Fold;

  ObserverWeights observer_;
  std::size_t bands_;
  std::vector<Values> lights_;    ///< With their luminance, E[3.2-4].
  Values carriers_;               ///< Of the pixel under way, chain by chain.
  FactorValues<double> factors_;  ///< At the cells' wavelengths.
  Xyz white_{1, 1, 1};
};

}  // namespace metamer
