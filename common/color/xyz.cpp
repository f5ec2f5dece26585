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

std::vector<const Spectrum*> with_observer(cie::Observer observer,
                                           std::vector<const Spectrum*> spectra) {
  for (const Spectrum& function : cie::matching_functions(observer)) spectra.push_back(&function);
  return spectra;
}

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

ObserverWeights under_light(cie::Observer observer, const Spectrum& emission,
                            const std::vector<double>& nm) {
  const Spectrum at{nm, nm};
  const Wavelengths cells = cells_of(with_observer(observer, {&emission, &at}));
  const ObserverWeights eye = observer_weights(observer, cells);
  std::vector<double> power = resample(emission, cells.nm(), Outside::zero).values;
  const double scale = luminance_scale(eye, power, 1);
  ObserverWeights lit;
  for (std::size_t c = 0; c < lit.weights.size(); ++c) {
    std::vector<double> seen = eye.weights[c];
    for (std::size_t i = 0; i < seen.size(); ++i) seen[i] *= scale * power[i] / cells.widths()[i];
    lit.weights[c] = shares(seen, cells, nm, Outside::hold);
  }
  return lit;
}

Xyz emission_xyz(const Spectrum& emission, cie::Observer observer) {
  const Wavelengths cells = cells_of(with_observer(observer, {&emission}));
  return to_xyz(observer_weights(observer, cells),
                resample(emission, cells.nm(), Outside::zero).values);
}

Xyz white_of(const Spectrum& emission, cie::Observer observer) {
  return to_xyz(under_light(observer, emission, {555}), {1});
}

double luminance_scale(const ObserverWeights& observer, const std::vector<double>& power,
                       double luminance) {
  const double scale = luminance / dot(observer.weights[1], power);
  return std::isfinite(scale) ? scale : 0.0;
}

}  // namespace metamer
