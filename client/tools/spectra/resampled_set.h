#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/tools/spectra/spectra_change.h"
#include "common/spectral/files/spectra_text.h"

/// Several spectra at the same new wavelengths, as one text: the source's dialog (4.7.1).
namespace metamer::client {

struct ResampleChoice {
  Wavelengths wavelengths;
  bool lights_first = true;  ///< Else they stay in their order.
  /// Of the lights to `observer`, at the new wavelengths (finite, above 0); nothing: as they are.
  std::optional<double> luminance = {};
  Observer observer = cie::observer_1931();
  SpectrumFormat format = SpectrumFormat::cgats;
};

struct ResampledRow {
  std::size_t original;    ///< Which of the spectra it was.
  ResampledSpectrum made;  ///< Before it is normalised.
  Spectrum written;        ///< As it stands in the text.
  double factor = 1;       ///< By which it was multiplied.
};

struct ResampledSet {
  std::vector<ResampledRow> rows;  ///< In the text's order.
  /// Errors: those of spectra_text, and a light that is dark at the new wavelengths.
  Result<std::string> text;
};

/// `spectra`: at least one.
ResampledSet resampled_set(const std::vector<LoadedSpectrum>& spectra,
                           const ResampleChoice& choice);

/// Numbers in nm between blanks, line breaks, commas or semicolons. Errors: a word that is no
/// number; those of Wavelengths::listed.
Result<Wavelengths> listed_wavelengths(std::string_view text);

}  // namespace metamer::client
