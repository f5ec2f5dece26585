#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/cli/report.h"
#include "client/cli/shared_options.h"
#include "client/tools/spectra/spectra_files.h"
#include "common/color/ends_of_data.h"
#include "common/spectral/cie.h"

/// The words of the `metamer spectra` commands, what they read and what they write. Problems are
/// reported; nothing then.
namespace metamer::cli {

/// What `metamer spectra` reads: files, or names of CIE illuminants and test colours.
struct SpectraOptions {
  bool json = false;
  std::vector<std::string> files;
  std::optional<std::string> entry;          ///< Of files with several spectra: this one.
  std::optional<std::string> as;             ///< "reflectance", "transmittance", "emission"
  std::optional<std::string> unit;           ///< "nm", "um"
  std::optional<std::string> scale;          ///< "1", "percent"
  bool clamp = false;                        ///< Values out of range become the nearest in it.
  Use use = Use::any;                        ///< What files are needed for.
  std::optional<std::string> interpolation;  ///< "linear", "sprague", "monotone-cubic"
  std::string observer = "cie-1931-2deg";    ///< Or "cie-1964-10deg", or a file.
  std::string under = "D65";                 ///< The light of reflectances.
  std::string weights = "lines";             ///< What these are between samples; or "astm".
};

struct SpectraOutputOptions {
  std::string file;                   ///< Empty: the text is printed.
  std::optional<std::string> format;  ///< "pairs", "uniform", "cgats"
};

/// Files, --entry, how they are read, --interpolation and --json. `single`: one file.
void declare_spectra(SpectraOptions& values, Options& options, bool single = false);
void declare_observer(SpectraOptions& values, Options& options);
void declare_under(SpectraOptions& values, Options& options);
/// --format and -o.
void declare_spectra_output(SpectraOutputOptions& values, Options& options, bool required = false);

std::optional<std::vector<client::LoadedSpectrum>> load_spectra(
    const SpectraOptions& options, const std::vector<std::string>& files, Report& report);
/// The same, where only one will do.
std::optional<client::LoadedSpectrum> load_one(const SpectraOptions& options,
                                               const std::string& file, Report& report);
/// What was guessed of a file, as notes.
void tell_notes(const client::LoadedSpectrum& one, Report& report);
/// One for a use: as the file says, else as the use wants it.
std::optional<Spectrum> load_for(Use use, const std::string& file, Report& report);
/// Where data end too early (common/color/ends_of_data), as a note; empty: nowhere.
void tell_ends(const std::string& label, const std::string& ends, Report& report);
/// The same of lights, and of reflectances under `lights`.
void tell_ends_of(const std::vector<client::LoadedSpectrum>& spectra,
                  const std::vector<CumulativeLight>& lights, const Observer& observer,
                  Report& report);
/// A light: a file, or a CIE illuminant. `option` stands in errors; what the observer misses of a
/// file is a note.
std::optional<Spectrum> load_light(const std::string& word, const std::string& option,
                                   const Observer& observer, Report& report);

/// An observer: a word that render has, or a file.
std::optional<Observer> load_observer(const std::string& word, Report& report);

/// By the words that render has; errors name the option.
Result<Wavelengths> wavelengths_of(const std::optional<std::string>& samples,
                                   const std::optional<std::string>& wavelengths);

/// Writes the file in the format that the options say, else in the one that its name asks for;
/// without a file prints the text. `quantity`: of all of them, nothing where they differ. Errors
/// are reported, and what the file can't say of them is noted.
ExitCode write_spectra(const SpectraOutputOptions& options,
                       const std::vector<NamedSpectrum>& spectra, std::optional<Quantity> quantity,
                       Report& report);
/// Whether those options make sense; reports what does not.
bool check_spectra_output(const SpectraOutputOptions& options, Report& report);

/// Says why the options make no sense, and ends the report.
ExitCode refuse(const std::string& why, Report& report);

}  // namespace metamer::cli
