#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/problem.h"
#include "common/spectral/files/spectra_text.h"

/// Spectra by the names of files and of the CIE's tables.
namespace metamer::client {

enum class SpectrumKind { emission, reflectance };

struct LoadedSpectrum {
  std::string label;  ///< For people: "D65", "paints.sp: red".
  std::string name;   ///< For a file: the entry's name, else the file's without its folder.
  bool emission;      ///< A light; else a reflectance.
  Spectrum spectrum;

  /// What it is where it has no data.
  Outside outside() const { return emission ? Outside::zero : Outside::hold; }
};

/// What is asked for of files.
struct SpectrumChoice {
  std::optional<std::string> entry = {};  ///< The one of that name; nothing: all of them.
  std::optional<SpectrumKind> kind = {};  ///< What they are; nothing: as load_spectra guesses.
};

/// Why there are no spectra.
struct SpectrumFault {
  Problem problem;
  std::string source = {};  ///< The text of problem.file, for the line that the problem stands in.
  bool choice = false;      ///< The file is sound; it is the choice among its spectra that fails.
};

template <class T>
using SpectrumResult = tl::expected<T, SpectrumFault>;

/// The spectra of a file, or the CIE illuminant or test colour of that name where there is no such
/// file; FILE#ENTRY is the entry of a file. A file's spectrum is taken for a reflectance where all
/// its values lie in 0..1, else for an emission, unless `choice` says which. The error is that of
/// the first word that has one.
SpectrumResult<std::vector<LoadedSpectrum>> load_spectra(const std::vector<std::string>& words,
                                                         const SpectrumChoice& choice = {});
/// The same, where only one will do.
SpectrumResult<LoadedSpectrum> load_one(const std::string& word, const SpectrumChoice& choice = {});

/// What keeps a spectrum from being a light's: power below 0. Empty: nothing.
std::string emission_fault(const Spectrum& spectrum);
/// Where it leaves the 0..1 of reflectances. Empty: nowhere.
std::string reflectance_fault(const Spectrum& spectrum);

/// What a file is written in by its name: CGATS where it is called .sp, .cmf or .ti3, else pairs.
SpectrumFormat format_for(const std::string& file);

}  // namespace metamer::client
