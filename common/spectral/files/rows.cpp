#include "common/spectral/files/rows.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace metamer::spectrum_text {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\f' || c == '\v'; }

/// A cell from `begin` to `end` of a line, without blanks at its ends.
Token make_cell(std::string_view line, std::size_t begin, std::size_t end, int number) {
  while (begin < end && is_blank(line[begin])) ++begin;
  while (begin < end && is_blank(line[end - 1])) --end;
  Token cell{.text = line.substr(begin, end - begin),
             .line = number,
             .column = static_cast<int>(begin) + 1};
  if (cell.text.starts_with('"')) {
    cell.text.remove_prefix(1);
    cell.unclosed = !cell.text.ends_with('"');
    if (!cell.unclosed) cell.text.remove_suffix(1);
  }
  return cell;
}

/// A line that begins with a number ends before a word that begins with #.
std::string_view without_comment(std::string_view line, std::size_t first) {
  if (std::string_view("0123456789.+-").find(line[first]) == std::string_view::npos) return line;
  for (std::size_t i = first + 1; i < line.size(); ++i)
    if (line[i] == '#' && is_blank(line[i - 1])) return line.substr(0, i);
  return line;
}

/// Where the cell that begins at `begin` ends: at a delimiter outside quotes.
std::size_t end_of_cell(std::string_view line, std::size_t begin, char delimiter) {
  bool quoted = false;
  for (std::size_t i = begin; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    const bool ends = delimiter == ' ' ? is_blank(line[i]) : line[i] == delimiter;
    if (ends && !quoted) return i;
  }
  return line.size();
}

/// A number without the signs between its thousands: "1 002.5", "1'002.5", "1.002,5" (where , is
/// the decimal sign and there) or "1,002.5". What may be anything else stays: "1.002" with decimal
/// commas.
std::string without_groups(std::string_view cell, char decimal) {
  const std::string text(cell);
  const char other = decimal == ',' ? '.' : ',';
  static constexpr std::string_view apostrophe = "\xE2\x80\x99";  // U+2019
  for (const std::string_view group :
       {std::string_view(" "), std::string_view("'"), apostrophe, std::string_view(&other, 1)}) {
    const std::size_t first = text.find(group);
    const std::size_t fraction = std::min(text.find(decimal), text.size());
    if (first == std::string::npos) continue;
    if (group[0] == other && fraction == text.size()) return text;
    std::string plain = text.substr(0, first);
    std::size_t at = first;
    while (at < fraction && text.compare(at, group.size(), group) == 0) {
      plain += text.substr(at + group.size(), 3);
      at += group.size() + 3;
    }
    const std::size_t sign = plain.find_first_of("+-") == 0 ? 1 : 0;
    const auto digits = [](std::string_view part) {
      return !part.empty() && part.find_first_not_of("0123456789") == std::string_view::npos;
    };
    const bool sound = first > sign && first <= sign + 3 && plain[sign] != '0' &&
                       digits(std::string_view(plain).substr(sign)) &&
                       (at == text.size() || text[at] == decimal || text[at] == '%');
    return sound ? plain + text.substr(std::min(at, text.size())) : text;
  }
  return text;
}

}  // namespace

bool is_row(const Row& row, const Dialect& dialect) {
  if (row.size() < 2 || !position_in(row.front(), dialect)) return false;
  return std::all_of(row.begin() + 1, row.end(), [&](const Token& cell) {
    return cell.text.empty() || number_in(cell, dialect);
  });
}

Row cut(std::string_view line, int number, const Dialect& dialect) {
  Row row;
  std::size_t begin = 0;
  while (true) {
    if (dialect.delimiter == ' ')
      while (begin < line.size() && is_blank(line[begin])) ++begin;
    if (dialect.delimiter == ' ' && begin == line.size()) return row;
    const std::size_t end = end_of_cell(line, begin, dialect.delimiter);
    row.push_back(make_cell(line, begin, end, number));
    if (end == line.size()) return row;
    begin = end + 1;
  }
}

bool is_percent(const Token& cell) { return cell.text.size() > 1 && cell.text.ends_with('%'); }

std::optional<double> number_in(const Token& cell, const Dialect& dialect) {
  std::string text = without_groups(cell.text, dialect.decimal);
  if (is_percent(cell)) {
    text.pop_back();
    while (!text.empty() && is_blank(text.back())) text.pop_back();
  }
  if (dialect.decimal == ',') {
    if (text.find('.') != std::string::npos) return std::nullopt;
    std::replace(text.begin(), text.end(), ',', '.');
  }
  const Result<double> number = parse_number({}, {.text = text});
  return number ? std::optional(*number) : std::nullopt;
}

std::optional<Labelled> position_in(const Token& cell, const Dialect& dialect) {
  if (const auto number = number_in(cell, dialect)) return Labelled{*number, {}};
  const auto labelled = labelled_wavelength(cell.text, dialect.decimal);
  return labelled && labelled->unit ? labelled : std::nullopt;
}

Lines::Lines(std::string_view text) {
  int number = 1;
  while (true) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    const std::size_t first = line.find_first_not_of(" \t\f\v");
    if (first != std::string_view::npos)
      lines_.push_back(
          {.text = without_comment(line, first), .number = number, .comment = line[first] == '#'});
    if (end == text.size()) {
      end_ = {.text = {}, .line = number, .column = static_cast<int>(end) + 1};
      return;
    }
    text.remove_prefix(end + 1);
    ++number;
  }
}

Dialect dialect_of(const Lines& lines) {
  constexpr std::size_t looked_at = 1000;
  const std::size_t count = std::min(lines.all().size(), looked_at);
  Dialect best = {' ', '.'};
  std::ptrdiff_t most = 0;
  for (const Dialect& dialect : dialects) {
    const auto end = lines.all().begin() + static_cast<std::ptrdiff_t>(count);
    const auto rows = std::count_if(lines.all().begin(), end, [&](const Lines::Line& line) {
      return !line.comment && is_row(cut(line.text, line.number, dialect), dialect);
    });
    if (rows > most) best = dialect;
    most = std::max(most, rows);
  }
  return best;
}

tl::unexpected<Problem> no_number(const std::string& file, const Token& cell,
                                  const Dialect& dialect) {
  const auto has = [&](const char* signs) {
    return cell.text.find_first_of(signs) != std::string_view::npos;
  };
  const bool digits = cell.text.find_first_not_of("0123456789.,' +-") == std::string_view::npos;
  const bool points = std::count(cell.text.begin(), cell.text.end(), '.') == 1;
  const bool grouped = has(" '") || (has(".") && has(",")) || (dialect.decimal == ',' && points);
  if (digits && grouped)
    return problem_at(file, cell,
                      quoted(cell.text) +
                          " is not a number: its decimal sign or what parts its "
                          "thousands can't be told");
  if (dialect.decimal == '.')
    if (auto number = parse_number(file, cell); !number)
      return tl::unexpected(std::move(number.error()));
  return problem_at(file, cell, quoted(cell.text) + " is not a number");
}

/// What all the words of a file say of its values, where they agree.
std::optional<Quantity> quantity_of(const Lines& lines, std::size_t end,
                                    const std::vector<Row>& headings) {
  for (const Row& row : headings)
    for (const Token& cell : row)
      if (const auto quantity = quantity_of_heading(cell.text)) return quantity;
  std::string words;
  for (std::size_t i = 0; i < end; ++i) words.append(lines.all()[i].text).append("\n");
  return quantity_in(words);
}

bool says_percent_above(const Lines& lines, std::size_t end) {
  for (std::size_t i = 0; i < end; ++i) {
    const std::string_view line = lines.all()[i].text;
    const std::string text = lower(line);
    const bool names = quantity_in(line) || text.find("unit") != std::string::npos;
    if (names && says_percent(line)) return true;
  }
  return false;
}

std::string describe(const Dialect& dialect) {
  const std::string separated = dialect.delimiter == '\t'  ? "tabs"
                                : dialect.delimiter == ';' ? "semicolons"
                                : dialect.delimiter == ',' ? "commas"
                                                           : "blanks";
  return separated + (dialect.decimal == ',' ? ", decimal commas" : "");
}

}  // namespace metamer::spectrum_text
