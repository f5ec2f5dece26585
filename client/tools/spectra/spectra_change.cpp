#include "client/tools/spectra/spectra_change.h"

#include <cmath>

#include "common/color/xyz.h"

namespace metamer::client {
namespace {

constexpr double unnoticed = 0.01;  ///< Of an integral.

}  // namespace

ResampledSpectrum resampled(const LoadedSpectrum& one, const Wavelengths& wavelengths) {
  Resampled values = resample(one.spectrum, wavelengths.nm(), one.outside());
  ResampledSpectrum result;
  result.without_data = values.below + values.above;
  result.spectrum = {.name = one.name, .spectrum = {wavelengths.nm(), std::move(values.values)}};
  const EnergyCheck energy = check_energy(one.spectrum, result.spectrum.spectrum, one.outside());
  result.energy = energy;
  const double whole = energy.before + energy.outside;
  if (!(whole > 0)) return result;
  result.leaves_out = energy.outside > unnoticed * whole;
  result.changes = energy.before > 0 && !(std::abs(energy.worst) <= unnoticed * energy.before);
  return result;
}

Result<NormalizedSpectrum> normalized(const LoadedSpectrum& one, const Observer& observer,
                                      double luminance) {
  if (!one.emission)
    return problem(quoted(one.label) +
                   " is taken for a reflectance, which has no luminance of its own");
  const double factor = luminance / emission_xyz(one.spectrum, observer)[1];
  if (!(factor > 0) || !std::isfinite(factor))
    return problem(quoted(one.label) + " is dark to this observer");
  NormalizedSpectrum result{{.name = one.name, .spectrum = one.spectrum}, factor};
  for (double& value : result.spectrum.spectrum.values) value *= factor;
  if (!make_spectrum(result.spectrum.spectrum.nm, result.spectrum.spectrum.values))
    return problem(quoted(one.label) + " overflows at that luminance");
  return result;
}

}  // namespace metamer::client
