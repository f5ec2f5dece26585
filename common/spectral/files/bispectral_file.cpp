#include "common/spectral/files/bispectral_file.h"

#include <algorithm>
#include <numeric>

#include "common/spectral/files/encoding.h"
#include "common/spectral/files/labels.h"
#include "common/spectral/files/rows.h"

namespace metamer {
namespace {

using namespace spectrum_text;

constexpr std::size_t looked_at = 1000;
constexpr double least_emission_nm = 1, most_emission_nm = 10'000;

std::vector<Lines::Line> rows_of(const Lines& lines) {
  std::vector<Lines::Line> rows;
  for (const Lines::Line& line : lines.all())
    if (!line.comment) rows.push_back(line);
  return rows;
}

/// How many cells of a line are numbers.
std::size_t numbers_in(const Row& row, const Dialect& dialect) {
  return static_cast<std::size_t>(std::count_if(row.begin(), row.end(), [&](const Token& cell) {
    return number_in(cell, dialect).has_value();
  }));
}

/// The way of writing in which the heading's cells behind the first are numbers, and most of the
/// first thousand lines': whole numbers look the same with decimal points and commas.
std::optional<Dialect> dialect_of_matrix(const std::vector<Lines::Line>& rows) {
  std::optional<Dialect> best;
  std::size_t most = 0;
  for (const Dialect& dialect : dialects) {
    const Row top = cut(rows.front().text, rows.front().number, dialect);
    const std::size_t wavelengths = numbers_in({top.begin() + 1, top.end()}, dialect);
    if (wavelengths + 1 != top.size() || wavelengths == 0) continue;
    std::size_t numbers = wavelengths;
    for (std::size_t i = 1; i < std::min(rows.size(), looked_at); ++i)
      numbers += numbers_in(cut(rows[i].text, rows[i].number, dialect), dialect);
    if (numbers <= most) continue;
    most = numbers;
    best = dialect;
  }
  return best;
}

/// The wavelength of a cell.
Result<double> wavelength_in(const Token& cell, const Dialect& dialect, const std::string& file,
                             const std::string& of, double least, double most) {
  const auto nm = number_in(cell, dialect);
  if (!nm) return no_number(file, cell, dialect);
  if (*nm >= least && *nm <= most) return *nm;
  return problem_at(file, cell,
                    "a wavelength of " + of + " lies in " + number_text(least) + ".." +
                        number_text(most) + " nm (it is " + number_text(*nm) + ")");
}

/// In which order wavelengths rise. Error: one is there twice; `cells` are their places.
Result<std::vector<std::size_t>> rising(const std::vector<double>& nm,
                                        const std::vector<Token>& cells, const std::string& file) {
  std::vector<std::size_t> order(nm.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return nm[a] < nm[b]; });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (nm[order[i]] == nm[order[i - 1]])
      return problem_at(file, cells[order[i]], number_text(nm[order[i]]) + " nm is there twice");
  return order;
}

/// A table as it is written.
struct Table {
  std::vector<double> excitation, emission, values;
  std::vector<Token> rows, columns;  ///< Where the wavelengths stand.
  std::vector<Token> cells;          ///< Where the values do.
};

Result<void> read_row(const Row& row, const Dialect& dialect, const std::string& file,
                      Table& table) {
  if (row.size() != table.emission.size() + 1)
    return problem_at(file, row.front(),
                      "expected " + std::to_string(table.emission.size() + 1) +
                          " cells as in the first line, not " + std::to_string(row.size()));
  if (table.values.size() + table.emission.size() > max_bispectral_cells)
    return problem_at(file, row.front(),
                      "at most " + std::to_string(max_bispectral_cells) + " values are possible");
  const auto nm =
      wavelength_in(row.front(), dialect, file, "excitation", excitation_from_nm, excitation_to_nm);
  if (!nm) return tl::unexpected(nm.error());
  table.excitation.push_back(*nm);
  table.rows.push_back(row.front());
  for (std::size_t i = 1; i < row.size(); ++i) {
    const auto value = number_in(row[i], dialect);
    if (!value) return no_number(file, row[i], dialect);
    if (!(*value >= 0))
      return problem_at(file, row[i],
                        "a matrix must not be negative (it is " + number_text(*value) + ")");
    table.values.push_back(*value);
    table.cells.push_back(row[i]);
  }
  return {};
}

Result<Table> read_table(const Lines& lines, const std::string& file) {
  const std::vector<Lines::Line> rows = rows_of(lines);
  const auto dialect = rows.empty() ? std::nullopt : dialect_of_matrix(rows);
  if (!dialect)
    return problem_at(file,
                      rows.empty() ? lines.end() : Token{rows.front().text, rows.front().number, 1},
                      "expected a word, then the wavelengths of the emission");
  Table table;
  const Row top = cut(rows.front().text, rows.front().number, *dialect);
  if (top.size() > spectrum_text::max_cells)
    return problem_at(
        file, top.front(),
        "at most " + std::to_string(spectrum_text::max_cells) + " columns are possible");
  for (std::size_t i = 1; i < top.size(); ++i) {
    const auto nm =
        wavelength_in(top[i], *dialect, file, "emission", least_emission_nm, most_emission_nm);
    if (!nm) return tl::unexpected(nm.error());
    table.emission.push_back(*nm);
    table.columns.push_back(top[i]);
  }
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const Row row = cut(rows[i].text, rows[i].number, *dialect);
    if (auto done = read_row(row, *dialect, file, table); !done)
      return tl::unexpected(std::move(done.error()));
  }
  if (table.excitation.size() < 2 || table.emission.size() < 2)
    return problem_at(file, lines.end(),
                      "a matrix needs two wavelengths of excitation and two of emission at least");
  return table;
}

}  // namespace

Result<BispectralMatrix> read_bispectral_file(std::string_view bytes, const std::string& file) {
  const auto text = utf8_text(bytes, file);
  if (!text) return tl::unexpected(text.error());
  const Lines lines(*text);
  const auto table = read_table(lines, file);
  if (!table) return tl::unexpected(table.error());
  const auto rows = rising(table->excitation, table->rows, file);
  if (!rows) return tl::unexpected(rows.error());
  const auto columns = rising(table->emission, table->columns, file);
  if (!columns) return tl::unexpected(columns.error());

  BispectralMatrix matrix;
  for (const std::size_t column : *columns) matrix.emission.push_back(table->emission[column]);
  for (const std::size_t row : *rows) {
    const double excited = table->excitation[row];
    matrix.excitation.push_back(excited);
    for (std::size_t j = 0; j < columns->size(); ++j) {
      const std::size_t cell = row * columns->size() + (*columns)[j];
      const double value = table->values[cell];
      // The diagonal passes between this column and the next.
      const bool crossed = j + 1 < columns->size() && matrix.emission[j + 1] > excited;
      if (value > 0 && matrix.emission[j] < excited && !crossed)
        return problem_at(file, table->cells[cell],
                          "light of " + number_text(excited) + " nm is re-radiated at " +
                              number_text(matrix.emission[j]) +
                              " nm: nothing re-radiates at a shorter wavelength");
      matrix.values.push_back(value);
    }
  }
  return matrix;
}

bool is_bispectral(std::string_view bytes) {
  constexpr std::string_view word = "excitation";
  constexpr std::size_t looked_at = 4096;
  const auto text = utf8_text(bytes.substr(0, looked_at), {});
  if (!text) return false;
  const Lines lines(*text);
  const std::vector<Lines::Line> rows = rows_of(lines);
  return !rows.empty() &&
         lower(rows.front().text.substr(0, 2 * word.size())).find(word) != std::string::npos;
}

}  // namespace metamer
