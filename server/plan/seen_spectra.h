#pragma once

#include "server/plan/spectral_fold.h"

namespace metamer {

/// The spectra at a place of a scene, at every whole nm from 360 to 830, in f64. A light has the
/// scale by which the scene's observer sees its luminance: what reaches the eye, summed over
/// wavelength by the observer, is the picture's X Y Z. Belongs to one thread.
class SeenSpectra {
 public:
  using Values = SpectralFold::Values;

  /// `scene` must outlive it.
  explicit SeenSpectra(const RenderScene& scene);

  /// What reaches it of a gather of one sample.
  Values eye(const Gather& gather);
  /// The lights, each by its weight.
  Values light(const Values& weights) const;
  /// The diffuse reflectance, 0 to 1.
  Values surface(std::uint32_t material);

 private:
  SpectralFold fold_;
};

}  // namespace metamer
