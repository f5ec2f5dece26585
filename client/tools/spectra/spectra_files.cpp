#include "client/tools/spectra/spectra_files.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "common/scene/files.h"
#include "common/spectral/cie.h"
#include "common/spectral/files/encoding.h"

namespace metamer::client {
namespace {

namespace fs = std::filesystem;

bool looks_like_reflectance(const Spectrum& spectrum) {
  return std::all_of(spectrum.values.begin(), spectrum.values.end(),
                     [](double value) { return value >= 0 && value <= 1; });
}

tl::unexpected<Problem> no_such(const std::string& word) {
  std::vector<std::string> known = cie::illuminant_names();
  known.insert(known.end(), cie::test_color_names().begin(), cie::test_color_names().end());
  return problem("there is no file, CIE illuminant or test colour " + metamer::quoted(word) +
                 did_you_mean(word, known));
}

/// A name from a file could command a terminal.
std::string printable(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
  return text;
}

/// The spectra of a file. `source` is its text, for the line of an error.
Result<std::vector<LoadedSpectrum>> read_spectra(const std::string& file, std::string& source) {
  Result<std::string> text = read_file(file, max_spectrum_file);
  if (!text) return tl::unexpected(std::move(text.error()));
  source = utf8_text(*text, file).value_or(*text);
  return parse_spectra(*text, file).map([&](std::vector<NamedSpectrum>&& spectra) {
    std::vector<LoadedSpectrum> loaded;
    for (NamedSpectrum& one : spectra)
      loaded.push_back(
          {.label = printable(one.name.empty() ? file : file + ": " + one.name),
           .name = printable(one.name.empty() ? fs::path(file).stem().string() : one.name),
           .emission = !looks_like_reflectance(one.spectrum),
           .samples = std::move(one.spectrum)});
    return loaded;
  });
}

Result<std::vector<LoadedSpectrum>> find_spectra(const std::string& word, std::string& source) {
  std::error_code error;
  if (fs::exists(word, error)) return read_spectra(word, source);
  const Spectrum* light = cie::illuminant(word);
  const Spectrum* paint = cie::test_color(word);
  if (light == nullptr && paint == nullptr) return no_such(word);
  return std::vector<LoadedSpectrum>{{.label = word,
                                      .name = word,
                                      .emission = light != nullptr,
                                      .samples = light != nullptr ? *light : *paint,
                                      .cie_table = true}};
}

/// A word, and the entry that it asks for: FILE#ENTRY, where there is no file of the whole name.
std::pair<std::string, std::optional<std::string>> split_entry(const std::string& word) {
  std::error_code error;
  const std::size_t hash = word.rfind('#');
  if (hash == std::string::npos || hash == 0 || fs::exists(word, error)) return {word, {}};
  return {word.substr(0, hash), word.substr(hash + 1)};
}

tl::unexpected<SpectrumFault> bad_choice(std::string message) {
  return tl::unexpected<SpectrumFault>(
      {.problem = problem(std::move(message)).value(), .choice = true});
}

/// All spectra of a word, or the one of that name.
SpectrumResult<std::vector<LoadedSpectrum>> load_word(const std::string& word,
                                                      std::optional<std::string> entry) {
  const auto [file, own_entry] = split_entry(word);
  if (own_entry) entry = own_entry;
  std::string source;
  Result<std::vector<LoadedSpectrum>> found = find_spectra(file, source);
  if (!found)
    return tl::unexpected<SpectrumFault>(
        {.problem = std::move(found.error()), .source = std::move(source)});
  if (!entry) return std::move(*found);
  std::vector<std::string> names;
  for (const LoadedSpectrum& one : *found) names.push_back(one.name);
  std::erase_if(*found, [&](const LoadedSpectrum& one) { return one.name != *entry; });
  if (!found->empty()) return std::move(*found);
  return bad_choice(metamer::quoted(file) + " has no spectrum named " + metamer::quoted(*entry) +
                    did_you_mean(*entry, names));
}

/// Takes a file's samples for what they are; a table of the CIE's is as it is.
SpectrumResult<void> interpolate(LoadedSpectrum& one, std::optional<Interpolation> asked) {
  if (one.cie_table) return {};
  auto curve = interpolated(one.samples, asked, one.role());
  if (!curve) return bad_choice(one.label + ": " + curve.error().message);
  one.curve = std::move(*curve);
  return {};
}

}  // namespace

SpectrumResult<std::vector<LoadedSpectrum>> load_spectra(const std::vector<std::string>& words,
                                                         const SpectrumChoice& choice) {
  std::vector<LoadedSpectrum> all;
  for (const std::string& word : words) {
    auto loaded = load_word(word, choice.entry);
    if (!loaded) return tl::unexpected(std::move(loaded.error()));
    for (LoadedSpectrum& one : *loaded) {
      if (choice.kind) one.emission = *choice.kind == SpectrumKind::emission;
      if (auto done = interpolate(one, choice.interpolation); !done)
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
  return bad_choice(metamer::quoted(word) + " has " + std::to_string(loaded->size()) +
                    " spectra; choose one, such as " +
                    metamer::quoted(word + "#" + loaded->front().name));
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

SpectrumFormat format_for(const std::string& file) {
  const std::string extension = fs::path(file).extension().string();
  const bool cgats = extension == ".sp" || extension == ".cmf" || extension == ".ti3";
  return cgats ? SpectrumFormat::cgats : SpectrumFormat::pairs;
}

}  // namespace metamer::client
