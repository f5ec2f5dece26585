#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/problem.h"
#include "common/spectral/spectrum.h"

namespace metamer {

/// One spectrum of a file; `name` is empty where the file gives none.
struct NamedSpectrum {
  std::string name;
  Spectrum spectrum;
};

/// Reads any of the formats, told apart by their content:
///   - uniform triplet (Fig. 4-4): first line `from to step`, then one value for each position;
///   - pairs (Fig. 4-4): lines `wavelength value`;
///   - CGATS: `.sp` and `.cmf` files, one or several spectra, named by SAMPLE_NAME, else SAMPLE_ID.
/// A word that begins with # makes the rest of its line a comment. Numbers have a decimal point
/// whatever the locale. `file` is used in errors only, which name line and column. Bounds:
/// max_spectrum_file bytes, max_spectra spectra, Wavelengths::max_count samples each.
Result<std::vector<NamedSpectrum>> parse_spectra(std::string_view text, const std::string& file);

inline constexpr std::size_t max_spectrum_file = 16u << 20;  ///< 4,001 samples × 400 spectra.

/// As many as a scene has materials. Without it a file of one-digit spectra costs 100 times its
/// size.
inline constexpr std::size_t max_spectra = 4096;

/// The one named `entry`, or the only one when `entry` is empty. Errors: no such entry (with "did
/// you mean"), several of that name, or several and no entry named. They have no place in a file
/// yet.
Result<Spectrum> select_entry(std::vector<NamedSpectrum> spectra, const std::string& entry);

}  // namespace metamer
