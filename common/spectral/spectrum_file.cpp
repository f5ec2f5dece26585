#include "common/spectral/spectrum_file.h"

#include <algorithm>
#include <array>

#include "common/spectral/cgats.h"
#include "common/spectral/tokens.h"
#include "common/spectral/wavelengths.h"

namespace metamer {
namespace {

using spectrum_text::parse_number;
using spectrum_text::problem_at;
using spectrum_text::Token;
using spectrum_text::Tokens;

using Spectra = Result<std::vector<NamedSpectrum>>;

Spectra one(Result<Spectrum> spectrum) {
  return std::move(spectrum).map([](Spectrum&& only) {
    return std::vector<NamedSpectrum>{{.name = {}, .spectrum = std::move(only)}};
  });
}

/// `from to step`, then one value for each position, on as many lines as it likes.
Spectra read_uniform(Tokens tokens, const std::string& file) {
  // Read the triplet.
  const Token first = *tokens.peek();
  std::array<double, 3> triplet{};
  std::string cited;
  for (double& number : triplet) {
    const Token token = *tokens.next();
    const Result<double> parsed = parse_number(file, token);
    if (!parsed) return tl::unexpected(parsed.error());
    number = *parsed;
    cited += (cited.empty() ? "" : " ") + number_text(number);
  }
  const Result<Wavelengths> positions = Wavelengths::uniform(triplet[0], triplet[1], triplet[2]);
  if (!positions) return problem_at(file, first, positions.error().message);

  // Read exactly as many values.
  const std::string wanted =
      "\"" + cited + "\" asks for " + std::to_string(positions->size()) + " values";
  std::vector<double> values;
  while (const std::optional<Token> token = tokens.next()) {
    if (values.size() == positions->size()) {
      return problem_at(file, *token, wanted + ", and here is one more");
    }
    const Result<double> value = parse_number(file, *token);
    if (!value) return tl::unexpected(value.error());
    values.push_back(*value);
  }
  if (values.size() < positions->size()) {
    return problem_at(file, tokens.end(),
                      wanted + ", but the file ends after " + std::to_string(values.size()));
  }
  return one(make_spectrum(positions->nm(), std::move(values)));
}

/// Lines `wavelength value`.
Spectra read_pairs(Tokens tokens, const std::string& file) {
  static constexpr const char* wanted = "expected \"wavelength value\" on each line";
  std::vector<double> nm, values;
  while (const std::optional<Token> left = tokens.next()) {
    // Take the two words of the line.
    const std::optional<Token> right = tokens.next();
    if (!right || right->line != left->line) {
      return problem_at(file, *left, std::string(wanted) + ", but there is no value");
    }
    if (tokens.peek() && tokens.peek()->line == left->line) {
      return problem_at(file, *tokens.peek(), std::string(wanted) + ", but there is a third word");
    }
    if (nm.size() == Wavelengths::max_count) {
      return problem_at(file, *left,
                        "at most " + std::to_string(nm.size()) + " samples are possible");
    }

    // Check them while their place is known.
    const Result<double> position = parse_number(file, *left);
    if (!position) return tl::unexpected(position.error());
    const Result<double> value = parse_number(file, *right);
    if (!value) return tl::unexpected(value.error());
    const auto wrong =
        nm.empty() ? wrong_positions({*position}) : wrong_positions({nm.back(), *position});
    if (wrong) return problem_at(file, *left, *wrong);
    nm.push_back(*position);
    values.push_back(*value);
  }
  return one(make_spectrum(std::move(nm), std::move(values)));
}

/// The words of the first line, at most four.
int words_in_first_line(Tokens tokens) {
  int words = 0;
  const int line = tokens.peek()->line;
  while (tokens.peek() && tokens.peek()->line == line && words < 4) {
    tokens.next();
    ++words;
  }
  return words;
}

std::vector<std::string> names_of(const std::vector<NamedSpectrum>& spectra) {
  std::vector<std::string> names;
  for (const NamedSpectrum& spectrum : spectra) {
    if (!spectrum.name.empty()) names.push_back(spectrum.name);
  }
  return names;
}

}  // namespace

Spectra parse_spectra(std::string_view text, const std::string& file) {
  if (text.size() > max_spectrum_file) {
    return tl::unexpected<Problem>({.field = {},
                                    .file = file,
                                    .message = "a spectrum file may have " +
                                               std::to_string(max_spectrum_file) + " bytes, not " +
                                               std::to_string(text.size())});
  }
  const Tokens tokens(text);
  if (!tokens.peek()) return problem_at(file, tokens.end(), "the file has no data");

  // A number comes first in the plain formats; in CGATS, a word.
  const Token first = *tokens.peek();
  const bool numeric =
      !first.text.empty() &&
      std::string_view("0123456789.+-").find(first.text.front()) != std::string_view::npos;
  if (!numeric) return spectrum_text::read_cgats(tokens, file);
  switch (words_in_first_line(tokens)) {
    case 2:
      return read_pairs(tokens, file);
    case 3:
      return read_uniform(tokens, file);
    default:
      return problem_at(file, first,
                        "the first line must be \"from to step\" or \"wavelength value\"");
  }
}

Result<Spectrum> select_entry(std::vector<NamedSpectrum> spectra, const std::string& entry) {
  // Without a name there must be no choice.
  if (entry.empty()) {
    if (spectra.size() == 1) return std::move(spectra.front().spectrum);
    const std::vector<std::string> names = names_of(spectra);
    return problem("the file has " + std::to_string(spectra.size()) +
                   " spectra; name one with entry" +
                   (names.empty() ? "" : ", say " + quoted(names.front())));
  }

  // A name must be one spectrum's alone.
  const auto has_name = [&](const NamedSpectrum& spectrum) { return spectrum.name == entry; };
  const auto found = std::find_if(spectra.begin(), spectra.end(), has_name);
  if (found == spectra.end()) {
    const std::vector<std::string> names = names_of(spectra);
    return problem("the file has no entry " + quoted(entry) +
                   (names.empty() ? "; its spectra have no names" : did_you_mean(entry, names)));
  }
  if (std::count_if(spectra.begin(), spectra.end(), has_name) > 1) {
    return problem("the file has several entries " + quoted(entry));
  }
  return std::move(found->spectrum);
}

}  // namespace metamer
