#pragma once

#include <vector>

#include "common/color/rgb_space.h"
#include "common/color/xyz.h"

/// Spectra as three numbers, as the method `rgb` has them: linear sRGB.
namespace metamer {

/// A light of that luminance, seen directly.
Rgb light_rgb(const Observer& observer, const Spectrum& emission, double luminance);

/// What turns a reflectance into linear sRGB under D65: a weight for each of R, G and B at each of
/// `nm` (rising), between which the reflectance is a straight line. Those of each sum to 1, so that
/// grey is grey: the tables' D65 and that of sRGB differ in the fourth digit.
class SurfaceRgb {
 public:
  SurfaceRgb(const Observer& observer, const std::vector<double>& nm);

  /// `values` has as many as nm.
  template <class Values>
  Rgb operator()(const Values& values) const {
    Rgb rgb{};
    for (std::size_t i = 0; i < weights_.size(); ++i)
      for (std::size_t channel = 0; channel < 3; ++channel)
        rgb[channel] += weights_[i][channel] * static_cast<double>(values[i]);
    return rgb;
  }

 private:
  std::vector<Rgb> weights_;
};

}  // namespace metamer
