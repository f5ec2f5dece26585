#include "common/spectral/files/wide_table.h"

#include <algorithm>

#include "common/spectral/wavelengths.h"

namespace metamer::spectrum_text {
namespace {

/// The columns of a line that are called after wavelengths, rising or falling.
Wide spectral_columns(const Row& row, const Dialect& dialect) {
  Wide found{.dialect = dialect};
  bool words = false;
  for (std::size_t c = 0; c < row.size() && row.size() <= max_cells; ++c) {
    auto label = labelled_wavelength(row[c].text, dialect.decimal);
    const auto number = number_in(row[c], dialect);
    if (!label && number && *number >= 100 && !is_percent(row[c])) label = Labelled{*number, {}};
    words |= !number;
    if (!label) continue;
    if (wrong_next(found.at, label->value)) return {};
    found.columns.push_back(c);
    found.at.push_back(label->value);
    if (label->unit) found.unit = label->unit;
  }
  // Mere numbers may be anything where no word says that they are headings.
  const std::size_t enough = words ? 3 : 8;
  return found.columns.size() >= enough ? found : Wide{};
}

/// The column that names spectra: one that is called so, else the first that is not spectral.
std::optional<std::size_t> name_column(const Row& heading, const Wide& wide) {
  std::optional<std::size_t> first;
  for (std::size_t c = 0; c < heading.size(); ++c) {
    if (std::find(wide.columns.begin(), wide.columns.end(), c) != wide.columns.end()) continue;
    if (lower(heading[c].text).find("name") != std::string::npos) return c;
    if (!first) first = c;
  }
  return first;
}

}  // namespace

std::optional<Wide> find_wide(const Lines& lines) {
  constexpr std::size_t looked_at = 200;
  std::optional<Wide> best;
  for (std::size_t i = 0; i + 1 < lines.all().size() && i < looked_at && !best; ++i) {
    const Lines::Line& line = lines.all()[i];
    if (line.comment) continue;
    for (const Dialect& dialect : dialects) {
      const Row top = cut(line.text, line.number, dialect);
      Wide found = spectral_columns(top, dialect);
      if (found.columns.size() <= (best ? best->columns.size() : 0)) continue;
      // The next line decides between decimal signs.
      const Lines::Line& next = lines.all()[i + 1];
      const Row row = cut(next.text, next.number, dialect);
      if (found.columns.back() >= row.size()) continue;
      // Samples may be called by numbers: a heading of wavelengths above some decides.
      const auto below = number_in(row.front(), dialect);
      if (says_wavelength(top.front().text) && below && *below >= 100) continue;
      const auto sound = std::all_of(
          found.columns.begin(), found.columns.end(),
          [&](std::size_t c) { return row[c].text.empty() || number_in(row[c], dialect); });
      if (!sound) continue;
      found.heading = i;
      best = std::move(found);
    }
  }
  return best;
}

Result<Contents> read_wide(const Lines& lines, const Wide& wide, const std::string& file) {
  const Lines::Line& top = lines.all()[wide.heading];
  const Row heading = cut(top.text, top.number, wide.dialect);
  const std::optional<std::size_t> names = name_column(heading, wide);
  Contents contents{.format = "a table with " + describe(wide.dialect) + ", a spectrum a line",
                    .unit = wide.unit,
                    .quantity = quantity_of(lines, wide.heading, {heading})};
  for (std::size_t c = 0; c < heading.size(); ++c)
    if (says_percent(heading[c].text)) contents.scale = Scale::percent;
  if (says_percent_above(lines, wide.heading)) contents.scale = Scale::percent;
  for (std::size_t i = wide.heading + 1; i < lines.all().size(); ++i) {
    const Lines::Line& line = lines.all()[i];
    if (line.comment) continue;
    const Row row = cut(line.text, line.number, wide.dialect);
    if (row.size() != heading.size())
      return problem_at(file, row.front(),
                        "expected " + std::to_string(heading.size()) + " cells as on line " +
                            std::to_string(top.number) + ", not " + std::to_string(row.size()));
    if (contents.spectra.size() == max_spectra)
      return problem_at(file, row.front(),
                        "at most " + std::to_string(max_spectra) + " spectra are possible");
    RawSpectrum spectrum{.begin = row.front()};
    if (names) spectrum.name = row[*names].text;
    for (std::size_t k = 0; k < wide.columns.size(); ++k) {
      const Token& cell = row[wide.columns[k]];
      if (cell.text.empty()) {
        ++spectrum.blank;
        continue;
      }
      if (is_percent(cell)) contents.scale = Scale::percent;
      const auto value = number_in(cell, wide.dialect);
      if (!value) return no_number(file, cell, wide.dialect);
      spectrum.at.push_back(wide.at[k]);
      spectrum.values.push_back(*value);
    }
    if (spectrum.at.empty()) return problem_at(file, row.front(), "the line has no values");
    contents.spectra.push_back(std::move(spectrum));
  }
  return contents;
}

}  // namespace metamer::spectrum_text
