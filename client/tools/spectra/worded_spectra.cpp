#include "client/tools/spectra/worded_spectra.h"

#include <filesystem>
#include <map>

#include "client/tools/spectra/spectrum_word.h"

namespace metamer::client {
namespace {

/// What stands after FILE or FILE#ENTRY: how it is read.
std::string reading_of_word(const std::string& word, const SpectrumWord& parsed) {
  return word.substr(parsed.name.size() + (parsed.entry ? 1 + parsed.entry->size() : 0));
}

void shorten_label(LoadedSpectrum& one, const std::string& file) {
  const std::size_t kept = std::filesystem::path(file).filename().string().size();
  if (one.label.starts_with(file)) one.label.erase(0, file.size() - kept);
}

}  // namespace

SpectrumResult<std::vector<WordedSpectrum>> worded_spectra(const std::string& word,
                                                           const SpectrumChoice& choice) {
  auto loaded = load_spectra({word}, choice);
  if (!loaded) return tl::unexpected(std::move(loaded.error()));
  const auto parsed = parse_spectrum_word(word);
  std::vector<WordedSpectrum> all;
  for (LoadedSpectrum& one : *loaded) {
    if (parsed->is_file) shorten_label(one, parsed->name);
    all.push_back({word, std::move(one)});
  }
  if (all.size() == 1) return all;
  const std::string reading = reading_of_word(word, *parsed);
  std::map<std::string, std::size_t> alike, seen;
  for (const WordedSpectrum& one : all) ++alike[one.spectrum.name];
  for (WordedSpectrum& one : all) {
    const std::string& name = one.spectrum.name;
    one.word = parsed->name + "#" + name;
    if (alike[name] > 1) one.word += "#" + std::to_string(++seen[name]);
    one.word += reading;
  }
  return all;
}

}  // namespace metamer::client
