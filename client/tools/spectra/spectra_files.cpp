#include "client/tools/spectra/spectra_files.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "client/tools/spectra/spectrum_word.h"
#include "common/color/illuminants.h"
#include "common/image/pixel_spectrum.h"
#include "common/printable.h"
#include "common/scene/files.h"
#include "common/spectral/cie.h"
#include "common/spectral/files/encoding.h"

namespace metamer::client {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Problem> no_such(const std::string& word) {
  std::vector<std::string> known = cie::illuminant_names();
  known.insert(known.end(), cie::test_color_names().begin(), cie::test_color_names().end());
  return tl::unexpected(metamer::unknown_name(
      "there is no file, CIE illuminant or test colour " + metamer::quoted(word), word, known));
}

Result<SpectrumFile> read_text(const std::string& name, const SpectrumChoice& choice,
                               std::string& source) {
  Result<std::string> bytes = read_file(name, max_spectrum_file);
  if (!bytes) return tl::unexpected(std::move(bytes.error()));
  source = utf8_text(*bytes, name).value_or(*bytes);
  return read_spectrum_file(*bytes, name, choice.reading.unit);
}

/// The spectra of a file. `source` is its text, for the line of an error.
Result<std::vector<LoadedSpectrum>> read_spectra(const std::string& name,
                                                 const SpectrumChoice& choice,
                                                 std::string& source) {
  auto file = is_picture_of_spectra(name) ? read_pixel_spectrum(fs::path(name), choice.entry)
                                          : read_text(name, choice, source);
  if (!file) return tl::unexpected(std::move(file.error()));
  std::vector<LoadedSpectrum> loaded;
  for (const NamedSpectrum& one : file->spectra) {
    // A name from a file could command a terminal.
    const std::string label = printable(one.name.empty() ? name : name + ": " + one.name);
    auto taken = interpret(*file, one, choice.reading, choice.use);
    if (!taken) return problem(label + ": " + taken.error().message);
    loaded.push_back(
        {.label = label,
         .name = printable(one.name.empty() ? fs::path(name).stem().string() : one.name),
         .quantity = taken->quantity,
         .samples = std::move(taken->spectrum),
         .format = file->format,
         .notes = std::move(taken->notes)});
  }
  return loaded;
}

Result<std::vector<LoadedSpectrum>> find_spectra(const std::string& word,
                                                 const SpectrumChoice& choice,
                                                 std::string& source) {
  std::error_code error;
  if (fs::exists(word, error)) return read_spectra(word, choice, source);
  LoadedSpectrum one{
      .label = word, .name = word, .quantity = Quantity::emission, .samples = {}, .computed = true};
  if (const Spectrum* paint = cie::test_color(word)) {
    one.quantity = Quantity::reflectance;
    one.samples = *paint;
  } else if (auto light = illuminant_named(word)) {
    one.samples = std::move(*light);
  } else {
    if (names_formula(word)) return tl::unexpected(std::move(light.error()));
    return no_such(word);
  }
  if (choice.reading.as) one.quantity = *choice.reading.as;
  return std::vector{std::move(one)};
}

tl::unexpected<SpectrumFault> bad_choice(std::string message) {
  return tl::unexpected<SpectrumFault>(
      {.problem = problem(std::move(message)).value(), .choice = true});
}

/// What a word says of its file, which goes before what is said of all files.
SpectrumChoice choice_for(const SpectrumWord& word, SpectrumChoice choice) {
  if (word.entry) choice.entry = word.entry;
  if (word.reading.as) choice.reading.as = word.reading.as;
  if (word.reading.unit) choice.reading.unit = word.reading.unit;
  if (word.reading.scale) choice.reading.scale = word.reading.scale;
  if (word.interpolation) choice.interpolation = word.interpolation;
  choice.reading.clamp |= word.reading.clamp;
  return choice;
}

/// All spectra of a word, or the one of that name.
SpectrumResult<std::vector<LoadedSpectrum>> load_word(const SpectrumWord& word,
                                                      const SpectrumChoice& choice) {
  const std::string& file = word.name;
  const std::optional<std::string>& entry = choice.entry;
  std::string source;
  Result<std::vector<LoadedSpectrum>> found = find_spectra(file, choice, source);
  if (!found)
    return tl::unexpected<SpectrumFault>(
        {.problem = std::move(found.error()), .source = std::move(source)});
  if (!entry) return std::move(*found);
  std::vector<std::string> names;
  for (const LoadedSpectrum& one : *found) names.push_back(one.name);
  std::vector<LoadedSpectrum> chosen;
  for (const std::size_t i : entries_named(names, *entry)) chosen.push_back(std::move((*found)[i]));
  if (!chosen.empty()) return chosen;
  const std::string hint = did_you_mean(*entry, names);
  return bad_choice(metamer::quoted(file) + " has no spectrum named " + metamer::quoted(*entry) +
                    (hint.empty() ? "; it has " + entry_choices(names) : hint));
}

/// A word that means the first of a word's spectra.
std::string first_choice(const std::string& word, const std::vector<LoadedSpectrum>& loaded) {
  const std::string& name = loaded.front().name;
  const auto alike = std::count_if(loaded.begin(), loaded.end(),
                                   [&](const LoadedSpectrum& one) { return one.name == name; });
  if (word.ends_with("#" + name)) return word + "#1";
  return word + "#" + name + (alike > 1 ? "#1" : "");
}

/// Takes a file's samples for what they are; a table of the CIE's is as it is.
SpectrumResult<void> interpolate(LoadedSpectrum& one, std::optional<Interpolation> asked) {
  if (one.computed) return {};
  if (one.emission() && one.samples.nm.size() == 1)
    one.notes.push_back("a line, as it has a single sample, at " +
                        number_text(one.samples.nm.front()) + " nm");
  auto curve = interpolated(one.samples, asked, one.role());
  if (!curve) return bad_choice(one.label + ": " + curve.error().message);
  one.curve = std::move(*curve);
  return {};
}

}  // namespace

SpectrumResult<std::vector<LoadedSpectrum>> load_spectra(const std::vector<std::string>& words,
                                                         const SpectrumChoice& choice) {
  std::vector<LoadedSpectrum> all;
  for (const std::string& text : words) {
    const auto word = parse_spectrum_word(text);
    if (!word) return bad_choice(word.error().message);
    const SpectrumChoice own = choice_for(*word, choice);
    auto loaded = load_word(*word, own);
    if (!loaded) return tl::unexpected(std::move(loaded.error()));
    for (LoadedSpectrum& one : *loaded) {
      if (auto done = interpolate(one, own.interpolation); !done)
        return tl::unexpected(std::move(done.error()));
      all.push_back(std::move(one));
    }
  }
  return all;
}

SpectrumResult<LoadedSpectrum> load_one(const std::string& word, const SpectrumChoice& choice) {
  auto loaded = load_spectra({word}, choice);
  if (!loaded) return tl::unexpected(std::move(loaded.error()));
  if (loaded->size() == 1) return std::move(loaded->front());
  std::vector<std::string> names;
  for (const LoadedSpectrum& one : *loaded) names.push_back(one.name);
  return bad_choice(metamer::quoted(word) + " has " + std::to_string(loaded->size()) +
                    " spectra; choose one, such as " +
                    metamer::quoted(first_choice(word, *loaded)) + ": " + entry_choices(names));
}

std::string emission_fault(const Spectrum& spectrum) {
  const auto& values = spectrum.values;
  return *std::min_element(values.begin(), values.end()) >= 0 ? "" : "a light has no power below 0";
}

std::string reflectance_fault(const Spectrum& spectrum) {
  for (std::size_t i = 0; i < spectrum.nm.size(); ++i)
    if (!(spectrum.values[i] >= 0 && spectrum.values[i] <= 1))
      return "a reflectance lies in 0..1 (it is " + number_text(spectrum.values[i]) + " at " +
             number_text(spectrum.nm[i]) + " nm)";
  return {};
}

std::optional<Quantity> common_quantity(const std::vector<LoadedSpectrum>& spectra) {
  for (const LoadedSpectrum& one : spectra)
    if (one.quantity != spectra.front().quantity) return std::nullopt;
  return spectra.empty() ? std::nullopt : std::optional(spectra.front().quantity);
}

SpectrumFormat format_for(const std::string& file) {
  const std::string extension = fs::path(file).extension().string();
  const bool cgats = extension == ".sp" || extension == ".cmf" || extension == ".ti3";
  return cgats ? SpectrumFormat::cgats : SpectrumFormat::pairs;
}

}  // namespace metamer::client
