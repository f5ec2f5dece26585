#pragma once

#include <vector>

#include "common/color/xyz.h"
#include "common/spectral/cie.h"
#include "server/plan/spectral_fold.h"

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

  /// By what each light's emission is multiplied for its luminance, E[3.2-4].
  const std::vector<double>& scales() const { return scales_; }

 private:
  Reference(const RenderScene& scene, const Observer& observer, const Wavelengths& wavelengths);

  using Values = SpectralFold::Values;
  Xyz white_under(const RenderScene& scene, const RenderLight& light,
                  const std::vector<double>& nm) const;
  std::vector<Values> light_powers(const RenderScene& scene, const std::vector<double>& nm);

  ObserverWeights observer_;
  Values scales_;
  Xyz white_{1, 1, 1};
  SpectralFold fold_;  ///< At the cells' wavelengths.
};

}  // namespace metamer
