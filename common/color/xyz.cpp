#include "common/color/xyz.h"

#include <cassert>
#include <cmath>
#include <numeric>

#include "common/spectral/lines.h"

namespace metamer {
namespace {

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  assert(a.size() == b.size());
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// The values at `nm`, at least two, of the straight lines that come nearest to a function by least
/// squares, from its integrals with the hat functions. Thomas's algorithm for a matrix of three
/// diagonals: ∫ hᵢ² = (nmᵢ₊₁ − nmᵢ₋₁) / 3, ∫ hᵢ hᵢ₊₁ = (nmᵢ₊₁ − nmᵢ) / 6.
std::vector<double> approximated(std::vector<double> integrals, const std::vector<double>& nm) {
  const std::size_t count = nm.size();
  std::vector<double> above(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double left = i > 0 ? nm[i] - nm[i - 1] : 0,
                 right = i + 1 < count ? nm[i + 1] - nm[i] : 0;
    const double pivot = (left + right) / 3 - (i > 0 ? left / 6 * above[i - 1] : 0);
    above[i] = right / 6 / pivot;
    integrals[i] = (integrals[i] - (i > 0 ? left / 6 * integrals[i - 1] : 0)) / pivot;
  }
  for (std::size_t i = count - 1; i-- > 0;) integrals[i] -= above[i] * integrals[i + 1];
  return integrals;
}

}  // namespace

std::vector<const Spectrum*> with_observer(const Observer& observer,
                                           std::vector<const Spectrum*> spectra) {
  for (const Spectrum& function : observer.functions()) spectra.push_back(&function);
  return spectra;
}

ObserverWeights observer_weights(const Observer& observer, const Wavelengths& wavelengths) {
  const std::array<Spectrum, 3>& functions = observer.functions();
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

ObserverWeights under_light(const Observer& observer, const Spectrum& emission,
                            const std::vector<double>& nm) {
  const Spectrum at{nm, nm};
  const Spectrum light = as_emission(emission);
  const Wavelengths cells = cells_of(with_observer(observer, {&light, &at}));
  const ObserverWeights eye = observer_weights(observer, cells);
  const std::vector<double> power = resample(light, cells.nm(), Outside::zero).values;
  const double scale = luminance_scale(eye, power, 1);
  ObserverWeights lit;
  for (std::size_t c = 0; c < lit.weights.size(); ++c) {
    std::vector<double> seen = eye.weights[c];
    for (std::size_t i = 0; i < seen.size(); ++i) seen[i] *= scale * power[i] / cells.widths()[i];
    lit.weights[c] = shares(seen, cells, nm, Outside::hold);
  }
  return lit;
}

ObserverWeights observer_of_bands(const Observer& observer, const std::vector<double>& nm) {
  const Spectrum at{nm, nm};
  const Wavelengths cells = cells_of(with_observer(observer, {&at}));
  const std::vector<double> widths = hat_widths(nm);
  ObserverWeights seen =
      observer_weights(observer, nm.size() == 1 ? *Wavelengths::listed(nm) : cells);
  if (nm.size() == 1) return seen;
  for (std::vector<double>& weights : seen.weights) {
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] /= cells.widths()[i];
    weights = approximated(shares(weights, cells, nm, Outside::zero), nm);
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] *= widths[i];
  }
  return seen;
}

Xyz emission_xyz(const Spectrum& emission, const Observer& observer) {
  const Spectrum light = as_emission(emission);
  const Wavelengths cells = cells_of(with_observer(observer, {&light}));
  return to_xyz(observer_weights(observer, cells),
                resample(light, cells.nm(), Outside::zero).values);
}

Xyz white_of(const Spectrum& emission, const Observer& observer) {
  return to_xyz(under_light(observer, emission, {555}), {1});
}

double luminance_scale(const ObserverWeights& observer, const std::vector<double>& power,
                       double luminance) {
  const double scale = luminance / dot(observer.weights[1], power);
  return std::isfinite(scale) ? scale : 0.0;
}

}  // namespace metamer
