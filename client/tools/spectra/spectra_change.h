#pragma once

#include <cstddef>

#include "client/tools/spectra/spectra_files.h"
#include "common/spectral/cie.h"

/// Spectra at other wavelengths, and of another luminance.
namespace metamer::client {

struct ResampledSpectrum {
  NamedSpectrum spectrum;
  std::size_t without_data = 0;  ///< New samples that lie outside the data.
  EnergyCheck energy;
  // What a sampling changes by 1 % of the integral or less is not worth a word.
  bool leaves_out = false;  ///< More than that of the whole integral lies outside the new samples.
  bool changes = false;     ///< So does what becomes of one interval between two of them.
};

/// By the interpolation of `one`; where it has no data an emission is 0, a reflectance holds its
/// end value.
ResampledSpectrum resampled(const LoadedSpectrum& one, const Wavelengths& wavelengths);

struct NormalizedSpectrum {
  NamedSpectrum spectrum;
  double factor;  ///< ξ of E[3.2-4].
};

/// The samples of a light of that luminance (finite, above 0) to that observer. Errors: `one` is a
/// reflectance; it is dark to the observer; its values overflow.
Result<NormalizedSpectrum> normalized(const LoadedSpectrum& one, const Observer& observer,
                                      double luminance);

/// The same light or reflectance, all its values multiplied; what is between its samples, too.
LoadedSpectrum scaled(LoadedSpectrum one, double factor);

}  // namespace metamer::client
