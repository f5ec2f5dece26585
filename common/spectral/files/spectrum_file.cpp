#include "common/spectral/files/spectrum_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>

#include "common/spectral/files/cgats.h"
#include "common/spectral/files/contents.h"
#include "common/spectral/files/encoding.h"
#include "common/spectral/files/table.h"
#include "common/spectral/files/tokens.h"
#include "common/spectral/files/xml.h"
#include "common/spectral/wavelengths.h"

namespace metamer {
namespace {

using spectrum_text::Contents;
using spectrum_text::parse_number;
using spectrum_text::problem_at;
using spectrum_text::RawSpectrum;
using spectrum_text::Token;
using spectrum_text::Tokens;

/// `from to step`, then one value for each position, on as many lines as it likes.
Result<Contents> read_uniform(Tokens tokens, const Wavelengths& positions, const std::string& cited,
                              const std::string& file) {
  const std::string wanted =
      quoted(cited) + " asks for " + std::to_string(positions.size()) + " values";
  RawSpectrum raw{.at = positions.nm(), .begin = *tokens.peek()};
  for (int i = 0; i < 3; ++i) tokens.next();
  while (const std::optional<Token> token = tokens.next()) {
    if (raw.values.size() == positions.size())
      return problem_at(file, *token, wanted + ", and here is one more");
    const Result<double> value = parse_number(file, *token);
    if (!value) return tl::unexpected(value.error());
    raw.values.push_back(*value);
  }
  if (raw.values.size() < positions.size())
    return problem_at(file, tokens.end(),
                      wanted + ", but the file ends after " + std::to_string(raw.values.size()));
  return Contents{.format = "uniform samples", .spectra = {std::move(raw)}};
}

/// The three numbers that stand alone on the first line: `from to step`. Nothing: there are no
/// such.
std::optional<std::array<double, 3>> triplet_of(Tokens tokens, std::string& cited) {
  std::array<double, 3> triplet{};
  const int line = tokens.peek()->line;
  for (double& number : triplet) {
    const std::optional<Token> token = tokens.next();
    if (!token || token->line != line) return std::nullopt;
    const Result<double> parsed = parse_number({}, *token);
    if (!parsed) return std::nullopt;
    number = *parsed;
    cited += (cited.empty() ? "" : " ") + number_text(number);
  }
  if (tokens.peek() && tokens.peek()->line == line) return std::nullopt;
  return triplet;
}

/// Whether the second line of a file has three words as the first: a table of two spectra.
bool goes_on_by_threes(Tokens tokens) {
  for (int i = 0; i < 3; ++i) tokens.next();
  if (!tokens.peek()) return false;
  int words = 0;
  for (const int line = tokens.peek()->line; tokens.peek() && tokens.peek()->line == line; ++words)
    tokens.next();
  return words == 3;
}

bool is_cgats(std::string_view text) {
  return text.find("BEGIN_DATA") != std::string_view::npos ||
         text.find("begin_data") != std::string_view::npos;
}

Result<Contents> read_contents(std::string_view text, const std::string& file) {
  if (text.find_first_not_of(" \t\n") != std::string_view::npos &&
      text[text.find_first_not_of(" \t\n")] == '<')
    return spectrum_text::read_xml(text, file);
  const Tokens tokens(text);
  if (!tokens.peek()) return problem_at(file, tokens.end(), "the file has no data");
  if (is_cgats(text)) return spectrum_text::read_cgats(tokens, text, file);

  // Three numbers ask for a uniform spectrum, if they can.
  std::string cited;
  if (const auto triplet = triplet_of(tokens, cited)) {
    const auto [from, to, step] = *triplet;
    const auto positions = Wavelengths::uniform(from, to, step);
    if (positions) return read_uniform(tokens, *positions, cited, file);
    if (!goes_on_by_threes(tokens))
      return problem_at(file, *tokens.peek(), positions.error().message);
  }
  return spectrum_text::read_table(text, file);
}

std::string range_text(const RawSpectrum& raw) {
  const auto [low, high] = std::minmax(raw.at.front(), raw.at.back());
  return number_text(low) + " to " + number_text(high);
}

/// A spectrum by nm, rising. Wavelengths below this are no nm that anybody measures reflectances or
/// lamps at: they are µm.
constexpr double shortest_nm = 50;
constexpr double least_nm = 1e-3, most_nm = 1e7;  ///< Gamma rays to 1 cm.

Result<NamedSpectrum> by_nm(RawSpectrum raw, std::optional<WavelengthUnit> unit,
                            const std::string& file) {
  if (!unit && std::max(raw.at.front(), raw.at.back()) < shortest_nm)
    return problem_at(file, raw.begin,
                      "wavelengths from " + range_text(raw) +
                          " look like µm; say in which unit they are (um or nm)");
  if (raw.at.size() > 1 && raw.at[1] < raw.at[0]) {
    std::reverse(raw.at.begin(), raw.at.end());
    std::reverse(raw.values.begin(), raw.values.end());
  }
  // 0.38 µm is 380 nm, to the last digit that was written.
  if (unit == WavelengthUnit::um)
    for (double& at : raw.at) at = std::round(at * 1e9) / 1e6;
  for (const double at : raw.at)
    if (!(at >= least_nm && at <= most_nm))
      return problem_at(file, raw.begin,
                        "a wavelength of " + number_text(at) + " nm is none that anybody measures");
  auto spectrum = make_spectrum(std::move(raw.at), std::move(raw.values));
  if (!spectrum) return problem_at(file, raw.begin, spectrum.error().message);
  return NamedSpectrum{std::move(raw.name), std::move(*spectrum), raw.blank};
}

/// How an entry may be called, that is told from all others.
std::string entry_name(const std::vector<std::string>& names, std::size_t i) {
  const auto end = names.begin() + static_cast<std::ptrdiff_t>(i);
  if (names[i].empty()) return "#" + std::to_string(i + 1);
  if (std::count(names.begin(), names.end(), names[i]) == 1) return names[i];
  return names[i] + "#" + std::to_string(std::count(names.begin(), end, names[i]) + 1);
}

/// Those of these, as many as one reads.
std::string choices_text(const std::vector<std::string>& names,
                         const std::vector<std::size_t>& entries) {
  constexpr std::size_t shown = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(entries.size(), shown); ++i)
    text += (i == 0 ? "" : ", ") + quoted(entry_name(names, entries[i]));
  return text + (entries.size() > shown ? ", …" : "");
}

std::vector<std::size_t> all_of(const std::vector<std::string>& names) {
  std::vector<std::size_t> all(names.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

}  // namespace

Result<SpectrumFile> read_spectrum_file(std::string_view bytes, const std::string& file,
                                        std::optional<WavelengthUnit> unit) {
  if (bytes.size() > max_spectrum_file) {
    return tl::unexpected<Problem>({.field = {},
                                    .file = file,
                                    .message = "a spectrum file may have " +
                                               std::to_string(max_spectrum_file) + " bytes, not " +
                                               std::to_string(bytes.size())});
  }
  auto text = utf8_text(bytes, file);
  if (!text) return tl::unexpected(std::move(text.error()));
  auto contents = read_contents(*text, file);
  if (!contents) return tl::unexpected(std::move(contents.error()));
  if (contents->spectra.empty())
    return tl::unexpected<Problem>(
        {.field = {}, .file = file, .message = "the file has wavelengths, but no values"});
  SpectrumFile result{
      .format = contents->format, .quantity = contents->quantity, .scale = contents->scale};
  result.notes = std::move(contents->notes);
  for (RawSpectrum& raw : contents->spectra) {
    auto named = by_nm(std::move(raw), unit ? unit : contents->unit, file);
    if (!named) return tl::unexpected(std::move(named.error()));
    const std::vector<double>& values = named->spectrum.values;
    result.largest = std::max(result.largest, *std::max_element(values.begin(), values.end()));
    result.spectra.push_back(std::move(*named));
  }
  return result;
}

Result<std::vector<NamedSpectrum>> parse_spectra(std::string_view bytes, const std::string& file) {
  return read_spectrum_file(bytes, file).map([](SpectrumFile&& read) {
    return std::move(read.spectra);
  });
}

std::vector<std::size_t> entries_named(const std::vector<std::string>& names,
                                       std::string_view entry) {
  const auto all_named = [&](std::string_view name) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == name) found.push_back(i);
    return found;
  };
  std::vector<std::size_t> found = all_named(entry);
  const std::size_t hash = entry.rfind('#');
  if (!found.empty() || hash == std::string_view::npos) return found;

  // Take it for a number among those of a name, or among all.
  std::size_t number = 0;
  const char* const last = entry.data() + entry.size();
  const auto [end, error] = std::from_chars(entry.data() + hash + 1, last, number);
  if (error != std::errc() || end != last) return {};
  if (hash > 0) found = all_named(entry.substr(0, hash));
  if (hash == 0) found = all_of(names);
  if (number < 1 || number > found.size()) return {};
  return {found[number - 1]};
}

std::string entry_choices(const std::vector<std::string>& names) {
  return choices_text(names, all_of(names));
}

Result<NamedSpectrum> select_entry(std::vector<NamedSpectrum> spectra, const std::string& entry) {
  std::vector<std::string> names;
  for (const NamedSpectrum& spectrum : spectra) names.push_back(spectrum.name);
  // Without a name there must be no choice.
  if (entry.empty()) {
    if (spectra.size() == 1) return std::move(spectra.front());
    return problem("the file has " + std::to_string(spectra.size()) +
                   " spectra; name one with entry: " + entry_choices(names));
  }

  // A name must be one spectrum's alone.
  const std::vector<std::size_t> found = entries_named(names, entry);
  if (found.size() > 1)
    return problem("the file has several entries " + quoted(entry) +
                   "; choose one: " + choices_text(names, found));
  if (!found.empty()) return std::move(spectra[found.front()]);
  Problem unknown = unknown_name("the file has no entry " + quoted(entry), entry, names);
  if (unknown.meant.empty()) unknown.message += "; it has " + entry_choices(names);
  return tl::unexpected(std::move(unknown));
}

}  // namespace metamer
