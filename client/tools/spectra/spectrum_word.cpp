#include "client/tools/spectra/spectrum_word.h"

#include <algorithm>
#include <filesystem>

namespace metamer::client {
namespace {

bool is_there(const std::string& file) {
  std::error_code error;
  return std::filesystem::exists(file, error);
}

/// Lets a word of reading_words count; one that was said later, which is read first, stays.
void set_reading(const std::string& word, SpectrumWord& to) {
  Reading& reading = to.reading;
  for (const Quantity one : {Quantity::reflectance, Quantity::transmittance, Quantity::emission})
    if (word == quantity_text(one) && !reading.as) reading.as = one;
  if (word == "nm" || word == "um")
    reading.unit = reading.unit.value_or(word == "nm" ? WavelengthUnit::nm : WavelengthUnit::um);
  if (word == "1" || word == "percent")
    reading.scale = reading.scale.value_or(word == "1" ? Scale::one : Scale::percent);
  if (word == "clamp") reading.clamp = true;
  if (const auto found = find_interpolation(word); found && !to.interpolation)
    to.interpolation = found;
}

bool is_reading_word(const std::string& word) {
  const auto& words = reading_words();
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// FILE of FILE#ENTRY, where there is one.
std::optional<std::string> file_of(const std::string& text) {
  if (is_there(text)) return text;
  for (std::size_t hash = text.rfind('#'); hash != std::string::npos && hash > 0;
       hash = text.rfind('#', hash - 1))
    if (const std::string file = text.substr(0, hash); is_there(file)) return file;
  return std::nullopt;
}

/// Why the last word after @ does not count, where what stands before it is a file.
Result<void> check_rest(const std::string& rest) {
  const std::size_t at = rest.rfind('@');
  if (at == std::string::npos || !file_of(rest.substr(0, at))) return {};
  const std::string word = rest.substr(at + 1);
  std::string all;
  for (const std::string& one : reading_words()) all += (all.empty() ? "" : ", ") + one;
  return problem(metamer::quoted(word) + " after @ says nothing of how " +
                 metamer::quoted(rest.substr(0, at)) + " is read" +
                 did_you_mean(word, reading_words()) + " (" + all + ")");
}

}  // namespace

const std::vector<std::string>& reading_words() {
  static const std::vector<std::string> words = [] {
    std::vector<std::string> all = {"reflectance", "transmittance", "emission", "nm", "um",
                                    "1",           "percent",       "clamp"};
    all.insert(all.end(), interpolation_words().begin(), interpolation_words().end());
    return all;
  }();
  return words;
}

Result<SpectrumWord> parse_spectrum_word(const std::string& text) {
  SpectrumWord word;
  std::string rest = text;
  // Take the words after @ off, from the last on.
  bool has_words = false;
  for (std::size_t at = rest.rfind('@'); !is_there(rest) && at != std::string::npos;
       at = rest.rfind('@')) {
    const std::string last = rest.substr(at + 1);
    if (!is_reading_word(last)) break;
    set_reading(last, word);
    has_words = true;
    rest.resize(at);
  }
  const auto file = file_of(rest);
  word.is_file = file.has_value();
  if (!word.is_file)
    if (Result<void> checked = check_rest(rest); !checked) return tl::unexpected(checked.error());
  const std::size_t hash = rest.rfind('#');
  word.name = file ? *file : rest.substr(0, hash == 0 ? rest.size() : hash);
  if (word.name != rest) word.entry = rest.substr(word.name.size() + 1);
  if (has_words && !word.is_file)
    return problem("there is no file " + metamer::quoted(word.name) + ", of which " +
                   metamer::quoted(text.substr(rest.size())) + " says how it is read");
  return word;
}

}  // namespace metamer::client
