#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/spectral/files/spectrum_file.h"

namespace metamer {

/// What a user says of a file; it goes before the file's own words.
struct Reading {
  std::optional<Quantity> as = {};
  std::optional<WavelengthUnit> unit = {};
  std::optional<Scale> scale = {};
  bool clamp = false;  ///< Values out of range become the nearest in it, and are counted.
};

/// What a spectrum is needed for. Nothing is asked of what is only looked at.
enum class Use { any, emission, property };

/// A file's spectrum as what it was taken for.
struct Interpreted {
  Spectrum spectrum;  ///< A reflectance or transmittance relative to 1.
  Quantity quantity;
  std::vector<std::string> notes = {};  ///< What was guessed or changed, a sentence each.
};

/// Gives a spectrum of `file` its quantity and scale: by `reading`, else by the file's words, else
/// by its use, else by a guess, which is noted: values within 0..1 are a reflectance, others an
/// emission. A property in a file that reaches above 5 without a word is in percents, which is
/// noted too; so is an emission that looks like a property. Errors, for a use: another quantity by
/// the file's words; an emission below 0; a property outside 0..1; no wavelength that is seen.
Result<Interpreted> interpret(const SpectrumFile& file, NamedSpectrum one, const Reading& reading,
                              Use use);

inline Result<Interpreted> interpret(const SpectrumFile& file, Spectrum spectrum,
                                     const Reading& reading, Use use) {
  return interpret(file, NamedSpectrum{{}, std::move(spectrum)}, reading, use);
}

/// "reflectance": for people.
std::string quantity_text(Quantity quantity);

}  // namespace metamer
