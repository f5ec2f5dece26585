#include "client/tools/spectra/spectra_change.h"

#include <algorithm>
#include <cmath>

#include "common/color/xyz.h"

namespace metamer::client {
namespace {

constexpr double unnoticed = 0.01;  ///< Of an integral.

/// As it is read, also at these wavelengths, seen or not.
Spectrum curve_at(const LoadedSpectrum& one, const std::vector<double>& wavelengths) {
  std::vector<double> nm = one.spectrum().nm;
  nm.insert(nm.end(), wavelengths.begin(), wavelengths.end());
  std::sort(nm.begin(), nm.end());
  nm.erase(std::unique(nm.begin(), nm.end()), nm.end());
  const auto curve =
      interpolated(one.samples, one.curve.interpolation, value_range(one.role()), nm);
  return curve ? curve->spectrum : one.spectrum();
}

}  // namespace

ResampledSpectrum resampled(const LoadedSpectrum& one, const Wavelengths& wavelengths) {
  const Spectrum curve = curve_at(one, wavelengths.nm());
  Resampled values = resample(curve, wavelengths.nm(), one.outside());
  ResampledSpectrum result;
  result.without_data = values.below + values.above;
  result.spectrum = {.name = one.name, .spectrum = {wavelengths.nm(), std::move(values.values)}};
  const EnergyCheck energy = check_energy(curve, result.spectrum.spectrum, one.outside());
  result.energy = energy;
  const double whole = energy.before + energy.outside;
  if (!(whole > 0)) return result;
  result.leaves_out = energy.outside > unnoticed * whole;
  result.changes = energy.before > 0 && !(std::abs(energy.worst) <= unnoticed * energy.before);
  return result;
}

Result<NormalizedSpectrum> normalized(const LoadedSpectrum& one, const Observer& observer,
                                      double luminance) {
  if (!one.emission())
    return problem(quoted(one.label) +
                   " is taken for a reflectance, which has no luminance of its own");
  const double factor = luminance / emission_xyz(one.spectrum(), observer)[1];
  if (!(factor > 0) || !std::isfinite(factor))
    return problem(quoted(one.label) + " is dark to this observer");
  NormalizedSpectrum result{{.name = one.name, .spectrum = one.samples}, factor};
  for (double& value : result.spectrum.spectrum.values) value *= factor;
  if (!make_spectrum(result.spectrum.spectrum.nm, result.spectrum.spectrum.values))
    return problem(quoted(one.label) + " overflows at that luminance");
  return result;
}

LoadedSpectrum scaled(LoadedSpectrum one, double factor) {
  for (Spectrum* spectrum : {&one.samples, &one.curve.spectrum})
    for (double& value : spectrum->values) value *= factor;
  return one;
}

}  // namespace metamer::client
