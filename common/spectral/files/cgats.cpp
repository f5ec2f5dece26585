#include "common/spectral/files/cgats.h"

#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "common/spectral/files/cgats_words.h"
#include "common/spectral/files/rows.h"
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

class Reader {
 public:
  Reader(Tokens tokens, std::string_view text, const std::string& file)
      : tokens_(tokens), text_(text), file_(file) {}

  Result<Contents> read();

 private:
  using Done = tl::expected<void, Problem>;

  Done read_keyword(const Token& keyword);
  Done read_format();
  Done read_data(const Token& begin);
  Done read_set(const Token& first);
  Result<std::vector<Token>> fields_of_set(const Token& first);
  std::optional<std::vector<Token>> fields_between_tabs(const Token& first);
  Done check_header(const Token& begin);
  Done find_positions();
  Done use_header_positions();
  Done check_order(const Token& token);

  const Setting* setting(std::string_view name) const {
    const auto found = settings_.find(name);
    return found != settings_.end() ? &found->second : nullptr;
  }

  Tokens tokens_;
  std::string_view text_;
  const std::string& file_;
  std::map<std::string_view, Setting> settings_;
  std::vector<Column> columns_;
  std::vector<double> nm_;  ///< Of the spectral columns, in their order.
  Contents contents_{.format = "CGATS", .unit = WavelengthUnit::nm};
};

// The keywords whose values are used; all others are read over.
constexpr std::string_view start_nm = "SPECTRAL_START_NM";
constexpr std::string_view end_nm = "SPECTRAL_END_NM";
constexpr std::string_view bands = "SPECTRAL_BANDS";
constexpr std::string_view norm = "SPECTRAL_NORM";
constexpr std::string_view field_count = "NUMBER_OF_FIELDS";
constexpr std::string_view set_count = "NUMBER_OF_SETS";
constexpr std::array used_keywords = {start_nm, end_nm, bands, norm, field_count, set_count};

Result<Contents> Reader::read() {
  // A file is keywords, a format, data; a further table may follow and keeps what it does not set.
  bool has_data = false;
  const std::optional<Token> first = tokens_.peek();
  while (const std::optional<Token> token = tokens_.next()) {
    Done done;
    if (is_keyword(*token, "BEGIN_DATA_FORMAT")) {
      done = read_format();
    } else if (is_keyword(*token, "BEGIN_DATA")) {
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
  if (contents_.spectra.empty()) {
    return problem_at(file_, *first, "no spectrum: the data have no columns like SPEC_380");
  }
  return std::move(contents_);
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

  if (is_keyword(keyword, "MEAS_TYPE") && value) contents_.quantity = quantity_of_type(*value);

  // Keep the numbers that matter here.
  for (const std::string_view used : used_keywords) {
    if (!is_keyword(keyword, used)) continue;
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
    if (is_keyword(*token, "END_DATA_FORMAT")) return {};
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
  return check_order(*first);
}

/// Columns rise or fall.
Reader::Done Reader::check_order(const Token& token) {
  std::vector<double> before;
  for (const double nm : nm_) {
    if (auto wrong = wrong_next(before, nm)) return problem_at(file_, token, std::move(*wrong));
    before.push_back(nm);
  }
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
  if (Done done = check_order(end->token); !done) return done;

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
    if (is_keyword(*token, "END_DATA")) {
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

/// The fields of a set that stands on one line between tabs, of which some may be blank. Nothing:
/// it is written otherwise.
std::optional<std::vector<Token>> Reader::fields_between_tabs(const Token& first) {
  const auto at = static_cast<std::size_t>(first.text.data() - text_.data());
  const std::size_t begin = text_.rfind('\n', at) + 1;
  const std::string_view line = text_.substr(begin, text_.find('\n', begin) - begin);
  if (line.find('\t') == std::string_view::npos) return std::nullopt;
  Row row = cut(line, first.line, {'\t', '.'});
  if (row.size() == columns_.size() + 1 && row.back().text.empty()) row.pop_back();
  if (row.size() != columns_.size()) return std::nullopt;
  while (tokens_.peek() && tokens_.peek()->line == first.line) tokens_.next();
  return row;
}

/// A set may run over several lines, so only its count of fields tells its end.
Result<std::vector<Token>> Reader::fields_of_set(const Token& first) {
  if (auto row = fields_between_tabs(first)) return std::move(*row);
  std::vector<Token> fields;
  for (std::optional<Token> token = first;; token = tokens_.next()) {
    if (!token) return problem_at(file_, tokens_.end(), "END_DATA is missing");
    if (token->unclosed) return problem_at(file_, *token, "the string has no closing quote");
    if (is_keyword(*token, "END_DATA"))
      return problem_at(file_, *token,
                        "the data end after " + std::to_string(fields.size()) + " of the " +
                            std::to_string(columns_.size()) + " fields of a set");
    fields.push_back(*token);
    if (fields.size() == columns_.size()) return fields;
  }
}

Reader::Done Reader::read_set(const Token& first) {
  const auto fields = fields_of_set(first);
  if (!fields) return tl::unexpected(fields.error());
  const Setting* divisor = setting(norm);
  RawSpectrum set{.at = nm_, .begin = first};
  bool has_name = false;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    // Keep the values, and the name; where a set has both a name and an id, its name.
    const Token& field = (*fields)[i];
    if (field.unclosed) return problem_at(file_, field, "the string has no closing quote");
    const Column::Kind kind = columns_[i].kind;
    if (kind == Column::Kind::spectral) {
      if (field.text.empty())
        return problem_at(file_, field, "there is no value for " + quoted(columns_[i].token.text));
      const Result<double> number = parse_number(file_, field);
      if (!number) return tl::unexpected(number.error());
      const double value = divisor != nullptr ? *number / divisor->value : *number;
      if (!std::isfinite(value)) {
        return problem_at(file_, field,
                          quoted(field.text) + " divided by SPECTRAL_NORM is not finite");
      }
      set.values.push_back(value);
    } else if (!field.text.empty() &&
               (kind == Column::Kind::name || (kind == Column::Kind::id && !has_name))) {
      set.name = field.text;
      has_name = kind == Column::Kind::name;
    }
  }
  if (divisor != nullptr) contents_.scale = Scale::one;
  if (!nm_.empty()) contents_.spectra.push_back(std::move(set));
  return {};
}

}  // namespace

Result<Contents> read_cgats(Tokens tokens, std::string_view text, const std::string& file) {
  return Reader(tokens, text, file).read();
}

}  // namespace metamer::spectrum_text
