#include "common/color/rgb_of_spectra.h"

#include "common/color/srgb.h"
#include "common/spectral/cie.h"

namespace metamer {

Rgb light_rgb(const Observer& observer, const Spectrum& emission, double luminance) {
  Xyz xyz = white_of(emission, observer);
  for (double& value : xyz) value *= luminance;
  return srgb::from_xyz(xyz);
}

SurfaceRgb::SurfaceRgb(const Observer& observer, const std::vector<double>& nm) {
  const ObserverWeights lit = under_light(observer, *cie::illuminant("D65"), nm);
  const auto& [x, y, z] = lit.weights;
  Rgb sum{};
  for (std::size_t i = 0; i < nm.size(); ++i) {
    weights_.push_back(srgb::from_xyz({x[i], y[i], z[i]}));
    for (std::size_t channel = 0; channel < 3; ++channel) sum[channel] += weights_[i][channel];
  }
  for (Rgb& weight : weights_)
    for (std::size_t channel = 0; channel < 3; ++channel) weight[channel] /= sum[channel];
}

}  // namespace metamer
