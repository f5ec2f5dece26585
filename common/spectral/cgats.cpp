#include "common/spectral/cgats.h"

#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "common/spectral/wavelengths.h"

namespace metamer::spectrum_text {
namespace {

/// All the wavelengths that one spectrum can have, and the columns of other kinds (names, XYZ,
/// Lab, device values) that measuring programs add.
constexpr std::size_t max_columns = Wavelengths::max_count + 1000;

/// A number of the header and where it stands.
struct Setting {
  double value = 0;
  Token token;
};

struct Column {
  enum class Kind { spectral, id, name, other };
  Kind kind = Kind::other;
  double nm = 0;  ///< As the name of a spectral column says.
  Token token;
};

/// "SPEC_380" and "nm380" are spectral. The number only has to be one: the header's positions go
/// before it.
Column make_column(const Token& token) {
  Column column{.token = token};
  if (token.text == "SAMPLE_ID") column.kind = Column::Kind::id;
  if (token.text == "SAMPLE_NAME") column.kind = Column::Kind::name;
  for (const std::string_view prefix : {"SPEC_", "nm"}) {
    if (!token.text.starts_with(prefix)) continue;
    const std::string_view number = token.text.substr(prefix.size());
    const char* last = number.data() + number.size();
    const auto [end, error] =
        std::from_chars(number.data(), last, column.nm, std::chars_format::fixed);
    if (error == std::errc() && end == last && std::isfinite(column.nm)) {
      column.kind = Column::Kind::spectral;
    }
  }
  return column;
}

/// Column names carry whole nanometres, rounded either way, or (colord's CIE-A.sp) thousandths.
bool names_position(const Column& column, double nm) {
  return std::abs(column.nm - nm) <= 1 || std::abs(column.nm / 1000 - nm) <= 1;
}

class Reader {
 public:
  Reader(Tokens tokens, const std::string& file) : tokens_(tokens), file_(file) {}

  Result<std::vector<NamedSpectrum>> read();

 private:
  using Done = tl::expected<void, Problem>;

  Done read_keyword(const Token& keyword);
  Done read_format();
  Done read_data(const Token& begin);
  Done read_set(const Token& first);
  Done check_header(const Token& begin);
  Done find_positions();
  Done use_header_positions();

  const Setting* setting(std::string_view name) const {
    const auto found = settings_.find(name);
    return found != settings_.end() ? &found->second : nullptr;
  }

  Tokens tokens_;
  const std::string& file_;
  std::map<std::string_view, Setting> settings_;
  std::vector<Column> columns_;
  std::vector<double> nm_;  ///< Of the spectral columns, in their order.
  std::vector<NamedSpectrum> spectra_;
};

// The keywords whose values are used; all others are read over.
constexpr std::string_view start_nm = "SPECTRAL_START_NM";
constexpr std::string_view end_nm = "SPECTRAL_END_NM";
constexpr std::string_view bands = "SPECTRAL_BANDS";
constexpr std::string_view norm = "SPECTRAL_NORM";
constexpr std::string_view field_count = "NUMBER_OF_FIELDS";
constexpr std::string_view set_count = "NUMBER_OF_SETS";
constexpr std::array used_keywords = {start_nm, end_nm, bands, norm, field_count, set_count};

Result<std::vector<NamedSpectrum>> Reader::read() {
  // A file is keywords, a format, data; a further table may follow and keeps what it does not set.
  bool has_data = false;
  const std::optional<Token> first = tokens_.peek();
  while (const std::optional<Token> token = tokens_.next()) {
    Done done;
    if (token->text == "BEGIN_DATA_FORMAT") {
      done = read_format();
    } else if (token->text == "BEGIN_DATA") {
      has_data = true;
      done = read_data(*token);
    } else {
      done = read_keyword(*token);
    }
    if (!done) return tl::unexpected(std::move(done.error()));
  }

  // Say what was expected where nothing was recognised.
  if (!has_data) {
    return problem_at(file_, first ? *first : tokens_.end(),
                      "no spectrum: expected \"from to step\", \"wavelength value\" or a CGATS "
                      "file with BEGIN_DATA");
  }
  if (spectra_.empty()) {
    return problem_at(file_, *first, "no spectrum: the data have no columns like SPEC_380");
  }
  return std::move(spectra_);
}

Reader::Done Reader::read_keyword(const Token& keyword) {
  // Take its value and read over the rest of the line.
  std::optional<Token> value;
  if (keyword.unclosed) return problem_at(file_, keyword, "the string has no closing quote");
  while (tokens_.peek() && tokens_.peek()->line == keyword.line) {
    const Token token = *tokens_.next();
    if (token.unclosed) return problem_at(file_, token, "the string has no closing quote");
    if (!value) value = token;
  }

  // Keep the numbers that matter here.
  for (const std::string_view used : used_keywords) {
    if (keyword.text != used) continue;
    if (!value) return problem_at(file_, keyword, std::string(used) + " has no value");
    const Result<double> number = parse_number(file_, *value);
    if (!number) return tl::unexpected(number.error());
    if (*number <= 0) return problem_at(file_, *value, std::string(used) + " must be above 0");
    settings_[used] = {.value = *number, .token = *value};
  }
  return {};
}

Reader::Done Reader::read_format() {
  columns_.clear();
  while (const std::optional<Token> token = tokens_.next()) {
    if (token->text == "END_DATA_FORMAT") return {};
    if (columns_.size() == max_columns) {
      return problem_at(file_, *token,
                        "at most " + std::to_string(max_columns) + " columns are possible");
    }
    columns_.push_back(make_column(*token));
  }
  return problem_at(file_, tokens_.end(), "END_DATA_FORMAT is missing");
}

Reader::Done Reader::check_header(const Token& begin) {
  if (columns_.empty()) {
    return problem_at(file_, begin, "BEGIN_DATA stands before any data format");
  }
  const Setting* fields = setting(field_count);
  if (fields != nullptr && fields->value != static_cast<double>(columns_.size())) {
    return problem_at(file_, fields->token,
                      "NUMBER_OF_FIELDS is " + number_text(fields->value) +
                          ", but the data format has " + std::to_string(columns_.size()));
  }
  return find_positions();
}

Reader::Done Reader::find_positions() {
  // Take the positions from the columns' names.
  nm_.clear();
  const Token* first = nullptr;
  for (const Column& column : columns_) {
    if (column.kind != Column::Kind::spectral) continue;
    if (first == nullptr) first = &column.token;
    nm_.push_back(column.nm);
  }
  if (first == nullptr) return {};
  if (nm_.size() > Wavelengths::max_count) {
    return problem_at(file_, *first,
                      "at most " + std::to_string(Wavelengths::max_count) +
                          " samples are possible, not " + std::to_string(nm_.size()));
  }

  // Prefer the header's, which are not rounded.
  if (setting(start_nm) != nullptr || setting(end_nm) != nullptr || setting(bands) != nullptr) {
    return use_header_positions();
  }
  if (auto wrong = wrong_positions(nm_)) return problem_at(file_, *first, std::move(*wrong));
  return {};
}

Reader::Done Reader::use_header_positions() {
  // Check that the three belong together and fit the columns.
  const Setting* start = setting(start_nm);
  const Setting* end = setting(end_nm);
  const Setting* count = setting(bands);
  if (start == nullptr || end == nullptr || count == nullptr) {
    const Setting* present = start != nullptr ? start : end != nullptr ? end : count;
    return problem_at(file_, present->token,
                      "SPECTRAL_START_NM, SPECTRAL_END_NM and SPECTRAL_BANDS belong together");
  }
  if (count->value != static_cast<double>(nm_.size())) {
    return problem_at(file_, count->token,
                      "SPECTRAL_BANDS is " + number_text(count->value) +
                          ", but the data format has " + std::to_string(nm_.size()) +
                          " spectral columns");
  }

  // Space them evenly, the last one exactly at the end.
  const std::size_t steps = nm_.size() - 1;
  const double range = end->value - start->value;
  for (std::size_t i = 0; i < steps; ++i) {
    nm_[i] = start->value + range * static_cast<double>(i) / static_cast<double>(steps);
  }
  nm_.back() = end->value;
  if (nm_.size() == 1 && range != 0) {
    return problem_at(file_, end->token,
                      "one band can't reach from " + number_text(start->value) + " to " +
                          number_text(end->value) + " nm");
  }
  if (auto wrong = wrong_positions(nm_)) return problem_at(file_, end->token, std::move(*wrong));

  // Believe no header that its own columns contradict.
  std::size_t band = 0;
  for (const Column& column : columns_) {
    if (column.kind != Column::Kind::spectral) continue;
    const double nm = nm_[band++];
    if (names_position(column, nm)) continue;
    return problem_at(
        file_, column.token,
        quoted(column.token.text) + " stands where the header puts " + number_text(nm) + " nm");
  }
  return {};
}

Reader::Done Reader::read_data(const Token& begin) {
  if (Done done = check_header(begin); !done) return done;
  const Setting* expected = setting(set_count);
  std::size_t sets = 0;
  while (const std::optional<Token> token = tokens_.next()) {
    // End where the file says so, and only with as many sets as it says.
    if (token->text == "END_DATA") {
      if (expected == nullptr || expected->value == static_cast<double>(sets)) return {};
      return problem_at(file_, *token,
                        "the data end after " + std::to_string(sets) +
                            " sets, but NUMBER_OF_SETS is " + number_text(expected->value));
    }
    if (expected != nullptr && static_cast<double>(sets) >= expected->value) {
      return problem_at(
          file_, *token,
          "more data than NUMBER_OF_SETS, " + number_text(expected->value) + ", stands for");
    }
    if (sets == max_spectra) {
      return problem_at(file_, *token,
                        "at most " + std::to_string(max_spectra) + " spectra are possible");
    }
    if (Done done = read_set(*token); !done) return done;
    ++sets;
  }
  return problem_at(file_, tokens_.end(), "END_DATA is missing");
}

Reader::Done Reader::read_set(const Token& first) {
  const Setting* divisor = setting(norm);
  NamedSpectrum set{.name = {}, .spectrum = {.nm = nm_, .values = {}}};
  bool has_name = false;
  std::optional<Token> token = first;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    // A set may run over several lines, so only its count of fields tells its end.
    if (i > 0) token = tokens_.next();
    if (!token) return problem_at(file_, tokens_.end(), "END_DATA is missing");
    if (token->unclosed) return problem_at(file_, *token, "the string has no closing quote");
    if (token->text == "END_DATA") {
      return problem_at(file_, *token,
                        "the data end after " + std::to_string(i) + " of the " +
                            std::to_string(columns_.size()) + " fields of a set");
    }

    // Keep the values, and the name; where a set has both a name and an id, its name.
    const Column::Kind kind = columns_[i].kind;
    if (kind == Column::Kind::spectral) {
      const Result<double> number = parse_number(file_, *token);
      if (!number) return tl::unexpected(number.error());
      const double value = divisor != nullptr ? *number / divisor->value : *number;
      if (!std::isfinite(value)) {
        return problem_at(file_, *token,
                          quoted(token->text) + " divided by SPECTRAL_NORM is not finite");
      }
      set.spectrum.values.push_back(value);
    } else if (kind == Column::Kind::name || (kind == Column::Kind::id && !has_name)) {
      set.name = token->text;
      has_name = kind == Column::Kind::name;
    }
  }
  if (!nm_.empty()) spectra_.push_back(std::move(set));
  return {};
}

}  // namespace

Result<std::vector<NamedSpectrum>> read_cgats(Tokens tokens, const std::string& file) {
  return Reader(tokens, file).read();
}

}  // namespace metamer::spectrum_text
