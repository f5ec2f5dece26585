#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/color/table_weights.h"
#include "common/problem.h"
#include "common/scene/interpolated.h"
#include "common/spectral/files/interpret.h"
#include "common/spectral/files/spectra_text.h"

/// Spectra by the names of files and of the CIE's tables.
namespace metamer::client {

struct LoadedSpectrum {
  std::string label;        ///< For people: "D65", "paints.sp: red".
  std::string name;         ///< For a file: the entry's name, else the file's without its folder.
  Quantity quantity;        ///< What it was taken for.
  Spectrum samples;         ///< As measured: what is written again.
  Interpolated curve = {};  ///< What the samples are taken for; where linear, the samples.
  bool computed = false;    ///< By formula or the CIE's table, which say what is between samples.
  std::string format = {};  ///< Of a file: "CGATS".
  std::vector<std::string> notes = {};  ///< What was guessed or changed, a sentence each.

  bool emission() const { return quantity == Quantity::emission; }
  const Spectrum& spectrum() const {
    return curve.interpolation == Interpolation::linear ? samples : curve.spectrum;
  }
  /// What it is where it has no data.
  Outside outside() const { return emission() ? Outside::zero : Outside::hold; }
  /// ASTM's weights are made for samples, and are an interpolation of their own.
  const Spectrum& seen_by(TableWeights weights) const {
    return weights == TableWeights::astm ? samples : spectrum();
  }
  SpectrumRole role() const { return emission() ? SpectrumRole::emission : SpectrumRole::property; }
};

/// What all of them are; nothing: they are of several kinds.
std::optional<Quantity> common_quantity(const std::vector<LoadedSpectrum>& spectra);

/// What is asked for of files.
struct SpectrumChoice {
  std::optional<std::string> entry = {};  ///< The one of that name; nothing: all of them.
  Reading reading = {};                   ///< How they are to be read.
  Use use = Use::any;                     ///< What they are needed for.
  /// What they are between their samples; nothing: as in a scene that says nothing.
  std::optional<Interpolation> interpolation = {};
};

/// Why there are no spectra.
struct SpectrumFault {
  Problem problem;
  std::string source = {};  ///< The text of problem.file, for the line that the problem stands in.
  bool choice = false;      ///< The file is sound; it is what was chosen of it that fails.
};

template <class T>
using SpectrumResult = tl::expected<T, SpectrumFault>;

/// The spectra of a file, or the illuminant (illuminant_named) or test colour of that name where
/// there is no such file; words are as parse_spectrum_word takes them. A file's spectrum is read,
/// taken for what it is (interpret) and interpolated as one of a scene. The CIE's are straight
/// lines, as CIE 15 has them. The error is that of the first word that has one.
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
