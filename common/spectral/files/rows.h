#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/spectral/files/labels.h"
#include "common/spectral/files/tokens.h"
#include "common/spectral/wavelengths.h"

namespace metamer::spectrum_text {

/// How a table is written.
struct Dialect {
  char delimiter;  ///< ' ': any run of blanks and tabs.
  char decimal;    ///< '.' or ','
};

/// A line of a table, cut into cells without quotes and blanks at their ends.
using Row = std::vector<Token>;

/// Cuts a line. A cell that begins with a quote ends with one.
Row cut(std::string_view line, int number, const Dialect& dialect);

/// A number with a % behind it.
bool is_percent(const Token& cell);

/// The finite number of a cell: what it has before a %, without what parts its thousands.
std::optional<double> number_in(const Token& cell, const Dialect& dialect);

/// The wavelength that a row's first cell says: a number, or one with a label.
std::optional<Labelled> position_in(const Token& cell, const Dialect& dialect);

/// Whether a row is a wavelength and values, some of which may be missing.
bool is_row(const Row& row, const Dialect& dialect);

/// The lines of a table: what is neither empty nor a comment (# at its beginning).
class Lines {
 public:
  explicit Lines(std::string_view text);

  struct Line {
    std::string_view text;
    int number;  ///< From 1.
    bool comment;
  };
  const std::vector<Line>& all() const { return lines_; }
  Token end() const { return end_; }

 private:
  std::vector<Line> lines_;
  Token end_;
};

/// The ways that tables are written, the likelier of two that both fit first.
inline constexpr std::array<Dialect, 8> dialects = {{{'\t', '.'},
                                                     {';', '.'},
                                                     {',', '.'},
                                                     {' ', '.'},
                                                     {'\t', ','},
                                                     {';', ','},
                                                     {' ', ','},
                                                     {',', ','}}};

/// The one in which most of the first thousand lines are rows (is_row).
Dialect dialect_of(const Lines& lines);

/// Why a cell is none.
tl::unexpected<Problem> no_number(const std::string& file, const Token& cell,
                                  const Dialect& dialect);

/// What the words above a table say of its values: its headings, else the lines before `end`.
std::optional<Quantity> quantity_of(const Lines& lines, std::size_t end,
                                    const std::vector<Row>& headings);

/// Whether the lines before `end` say that values are percents: one that names a quantity or a
/// unit.
bool says_percent_above(const Lines& lines, std::size_t end);

/// All the wavelengths of a line of them, and the columns of other kinds beside.
inline constexpr std::size_t max_cells = Wavelengths::max_count + 1000;

/// "semicolons, decimal commas": for people.
std::string describe(const Dialect& dialect);

}  // namespace metamer::spectrum_text
