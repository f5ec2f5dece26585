#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/spectral/files/spectrum_file.h"
#include "common/spectral/files/tokens.h"

namespace metamer::spectrum_text {

/// A spectrum as a file has it: wavelengths rise or fall, in the file's unit.
struct RawSpectrum {
  std::string name = {};
  std::vector<double> at = {}, values = {};  ///< As many, at least one.
  Token begin = {};                          ///< Where it begins, for errors.
  std::size_t blank = 0;                     ///< Cells that say nothing, which it has no sample of.
};

/// What one of the readers found.
struct Contents {
  std::string format;
  std::optional<WavelengthUnit> unit = {};
  std::optional<Quantity> quantity = {};
  std::optional<Scale> scale = {};
  std::vector<RawSpectrum> spectra = {};
  std::vector<std::string> notes = {};  ///< What was guessed of all of it.
};

/// What is wrong with a wavelength after those `before` it, which rise or fall. Nothing: it is
/// sound.
std::optional<std::string> wrong_next(const std::vector<double>& before, double next);

}  // namespace metamer::spectrum_text
