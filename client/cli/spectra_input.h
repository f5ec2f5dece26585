#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/cli/options.h"
#include "client/cli/report.h"
#include "common/color/xyz.h"
#include "common/spectral/spectra_text.h"

/// What the `metamer spectra` commands read and write. No server is asked.
namespace metamer::cli {

struct LoadedSpectrum {
  std::string label;  ///< For people: "D65", "paints.sp: red".
  std::string name;   ///< For a file: the entry's name, else the file's without its folder.
  bool emission;      ///< A light; else a reflectance.
  Spectrum spectrum;

  /// What it is where it has no data.
  Outside outside() const { return emission ? Outside::zero : Outside::hold; }
};

/// The spectra of a file, or the CIE illuminant or test colour of that name where there is no such
/// file. A file's spectrum is taken for a reflectance where all its values lie in 0..1, else for an
/// emission, unless the options say which. Reports what is wrong; nothing then.
std::optional<std::vector<LoadedSpectrum>> load_spectra(const SpectraOptions& options,
                                                        const std::vector<std::string>& files,
                                                        Report& report);
/// The same, where only one will do.
std::optional<LoadedSpectrum> load_one(const SpectraOptions& options, const std::string& file,
                                       Report& report);
/// A light: a file, or a CIE illuminant. `option` stands in errors.
std::optional<Spectrum> load_light(const std::string& word, const std::string& option,
                                   Report& report);

// By the words that render has; errors name the option.
Result<cie::Observer> observer_of(const std::string& word);
Result<Wavelengths> wavelengths_of(const std::optional<std::string>& samples,
                                   const std::optional<std::string>& wavelengths);

/// Where to sum E[3.2-2] of a light: at its own samples where they are 5 nm apart at most, as the
/// CIE does with its tables; else as below.
Wavelengths own_wavelengths(const Spectrum& light);
/// At every nm from 360 to 830, as the renderer's reference, and wherever the light itself has
/// samples there, so that no line falls between.
Wavelengths fine_wavelengths(const Spectrum& light);

/// Writes the file in the format that the options say, else CGATS where it is called .sp, .cmf or
/// .ti3, else pairs; without a file prints the text. Errors are reported.
ExitCode write_spectra(const SpectraOutputOptions& options,
                       const std::vector<NamedSpectrum>& spectra, Report& report);
/// Whether those options make sense; reports what does not.
bool check_spectra_output(const SpectraOutputOptions& options, Report& report);

}  // namespace metamer::cli
