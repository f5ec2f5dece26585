#pragma once

#include <optional>
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
  std::size_t blank = 0;  ///< Cells of a file that say nothing, which it has no sample of.
};

/// What the values of a spectrum are.
enum class Quantity { reflectance, transmittance, emission };

enum class WavelengthUnit { nm, um };

/// How the values of a reflectance or a transmittance are written.
enum class Scale { one, percent };

/// No paper reflects five times the light, fluorescent or not.
inline constexpr double surely_percent = 5;

/// A file of spectra, and what it says of them itself.
struct SpectrumFile {
  std::string format;                       ///< "CGATS", "table", …: for people.
  std::optional<Quantity> quantity = {};    ///< Nothing: the file does not say.
  std::optional<Scale> scale = {};          ///< The same; values are as written there.
  std::vector<NamedSpectrum> spectra = {};  ///< At least one; nm, rising.
  double largest = 0;                       ///< Of all their values.
  std::vector<std::string> notes = {};      ///< What was guessed of all of it, a sentence each.
};

/// Reads any of the formats, told apart by their content:
///   - uniform triplet (Fig. 4-4): first line `from to step`, then one value for each position;
///   - tables: lines `wavelength value value …`, or a line of wavelengths and one line for each
///     spectrum, separated by commas, semicolons, tabs or blanks, with decimal points or commas;
///     headings name the spectra and the units; pairs (Fig. 4-4), CSV, OceanView's text,
///     Sekonic's and UPRtek's exports are such tables;
///   - CGATS (ISO 28178): `.sp`, `.cmf`, `.ti3`, i1Profiler's exports; MEAS_TYPE says what it is;
///   - CxF3 (ISO 17972): reflectance, transmittance and emission spectra;
///   - IES TM-27: `.spdx`.
/// Text is UTF-8, UTF-16 or Latin-1. Wavelengths may fall and may be in µm where the file or `unit`
/// says so; `unit` goes before the file. Errors name `file`, line and column; wavelengths that look
/// like µm without a word are one. Bounds: max_spectrum_file bytes, max_spectra spectra,
/// Wavelengths::max_count samples each.
Result<SpectrumFile> read_spectrum_file(std::string_view bytes, const std::string& file,
                                        std::optional<WavelengthUnit> unit = {});

/// Its spectra alone.
Result<std::vector<NamedSpectrum>> parse_spectra(std::string_view bytes, const std::string& file);

inline constexpr std::size_t max_spectrum_file = 16u << 20;  ///< 4,001 samples × 400 spectra.

/// As many as a scene has materials. Without it a file of one-digit spectra costs 100 times its
/// size.
inline constexpr std::size_t max_spectra = 4096;

/// Which of the spectra of these names an entry means: all of that name; where none is called so,
/// the second of a name by "NAME#2", the second of all by "#2".
std::vector<std::size_t> entries_named(const std::vector<std::string>& names,
                                       std::string_view entry);

/// How entries may be called so that each is told from all others, as many as one reads: "red#1",
/// "red#2", "blue".
std::string entry_choices(const std::vector<std::string>& names);

/// The one that `entry` means, or the only one when `entry` is empty. Errors: no such entry (with
/// "did you mean"), several of that name, or several and no entry named. They have no place in a
/// file yet.
Result<NamedSpectrum> select_entry(std::vector<NamedSpectrum> spectra, const std::string& entry);

}  // namespace metamer
