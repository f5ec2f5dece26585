#include "common/color/xyz.h"

#include <cassert>
#include <cmath>
#include <numeric>

namespace metamer {
namespace {

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  assert(a.size() == b.size());
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

ObserverWeights observer_weights(cie::Observer observer, const Wavelengths& wavelengths) {
  const std::array<Spectrum, 3>& functions = cie::matching_functions(observer);
  ObserverWeights result;
  for (std::size_t c = 0; c < functions.size(); ++c) {
    std::vector<double>& weights = result.weights[c];
    weights = resample(functions[c], wavelengths.nm(), Outside::zero).values;
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] *= wavelengths.widths()[i];
  }
  return result;
}

Xyz to_xyz(const ObserverWeights& observer, const std::vector<double>& power) {
  const auto& [x, y, z] = observer.weights;
  return {dot(x, power), dot(y, power), dot(z, power)};
}

ObserverWeights under_light(ObserverWeights observer, const std::vector<double>& power) {
  const double scale = luminance_scale(observer, power, 1);
  for (std::vector<double>& weights : observer.weights)
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] *= scale * power[i];
  return observer;
}

double luminance_scale(const ObserverWeights& observer, const std::vector<double>& power,
                       double luminance) {
  const double scale = luminance / dot(observer.weights[1], power);
  return std::isfinite(scale) ? scale : 0.0;
}

}  // namespace metamer
