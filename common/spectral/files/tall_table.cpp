#include "common/spectral/files/tall_table.h"

#include <algorithm>
#include <cmath>

#include "common/spectral/wavelengths.h"

namespace metamer::spectrum_text {
namespace {

std::string unusable(const std::string& quantity) {
  return quantity + " is neither a reflectance, a transmittance nor a power";
}

/// Whether a heading is a unit and names nothing. "1" is one in a line of units.
bool is_unit(std::string_view heading, bool among_units) {
  if (unit_in(heading)) return true;
  if (heading == "1" || heading == "[1]") return among_units;
  return says_percent(heading) && heading.find_first_not_of("%[]()/ \t") == heading.npos;
}

/// Whether a line of headings from `first` on holds units alone.
bool is_line_of_units(const Row& heading, std::size_t first) {
  return std::all_of(
      heading.begin() + static_cast<std::ptrdiff_t>(first), heading.end(),
      [](const Token& cell) { return cell.text.empty() || is_unit(cell.text, true); });
}

/// A table whose lines are wavelengths, and whose columns are spectra.
class Tall {
 public:
  Tall(const Lines& lines, const Dialect& dialect, const std::string& file)
      : lines_(lines), dialect_(dialect), file_(file) {}

  Result<Contents> read();

 private:
  using Done = tl::expected<void, Problem>;

  bool find_first_row();
  Done read_headings();
  Done check_headings() const;
  Done check_commas() const;
  Done share_scale();
  void note_whole_numbers();
  void begin_block(double position);
  Done read_row(const Row& row);
  Done read_rows();
  std::string name_of(std::size_t column) const;
  std::string format() const;

  const Lines& lines_;
  Dialect dialect_;
  const std::string& file_;
  std::size_t first_ = 0;  ///< The first row, in lines_.
  Row first_row_;
  std::vector<Row> headings_;  ///< Lines above it with as many cells.
  std::size_t position_ = 0;   ///< The column of the wavelengths.
  /// Rows are called after their wavelengths, among other rows: a spectrometer for lamps.
  bool labelled_ = false;
  std::vector<std::size_t> percent_cells_;  ///< Of each spectrum: numbers with a % behind.
  std::vector<RawSpectrum> longer_;  ///< Of several blocks of labelled rows, the longest so far.
  Contents contents_;
};

bool Tall::find_first_row() {
  for (; first_ < lines_.all().size(); ++first_) {
    const Lines::Line& line = lines_.all()[first_];
    if (line.comment) continue;
    first_row_ = cut(line.text, line.number, dialect_);
    if (is_row(first_row_, dialect_)) return true;
    // What begins with a number and is no row is a mistake in the data, not a heading.
    if (!first_row_.empty() && number_in(first_row_.front(), dialect_)) return true;
  }
  return false;
}

Tall::Done Tall::read_headings() {
  for (std::size_t i = 0; i < first_; ++i) {
    Lines::Line line = lines_.all()[i];
    if (line.comment) line.text.remove_prefix(line.text.find('#') + 1);
    Row row = cut(line.text, line.number, dialect_);
    if (row.size() == first_row_.size()) headings_.push_back(std::move(row));
  }
  for (const Row& heading : headings_)
    for (std::size_t c = heading.size(); c-- > 0;)
      if (says_wavelength(heading[c].text) && c + 1 < heading.size()) position_ = c;
  for (const Row& heading : headings_)
    if (const auto unit = unit_in(heading[position_].text)) contents_.unit = unit;
  contents_.quantity = quantity_of(lines_, first_, headings_);
  return check_headings();
}

/// Other axes and quantities, and a second axis, are no spectra by wavelength.
Tall::Done Tall::check_headings() const {
  for (std::size_t i = 0; i < first_; ++i) {
    const Lines::Line& line = lines_.all()[i];
    const std::string text = lower(line.text);
    const Token begin{.text = {}, .line = line.number, .column = 1};
    if (text.starts_with("yaxis mode")) {
      const std::size_t after = line.text.find(':');
      const std::string_view what = line.text.substr(std::min(after, line.text.size() - 1) + 1);
      if (const std::string quantity = unusable_quantity(what); !quantity.empty())
        return problem_at(file_, begin, unusable(quantity));
    }
    if (text.find("xaxis mode") == std::string::npos) continue;
    if (text.find("wavelength") == std::string::npos)
      return problem_at(file_, begin, "wavelengths are needed, and the file has another axis");
  }
  for (const Row& heading : headings_)
    for (std::size_t c = 0; c < heading.size(); ++c) {
      if (c > position_ && says_wavelength(heading[c].text) &&
          !says_wavelength(heading[position_].text))
        return problem_at(file_, heading[c],
                          "the column of the wavelengths has to stand before those of values");
      const std::string axis = c == position_ ? unusable_axis(heading[c].text) : "";
      if (!axis.empty())
        return problem_at(file_, heading[c], "wavelengths in nm or µm are needed, not " + axis);
      if (c > position_ && says_wavelength(heading[c].text))
        return problem_at(
            file_, heading[c],
            "a second column of wavelengths: a table has one; give each its own file");
      const std::string quantity = c > position_ ? unusable_quantity(heading[c].text) : "";
      if (!quantity.empty()) return problem_at(file_, heading[c], unusable(quantity));
    }
  return {};
}

/// Where one column is in percents, all are: what does not say so is relative to 1 until here, but
/// where it can't be.
Tall::Done Tall::share_scale() {
  std::vector<bool> percent(contents_.spectra.size(), says_percent_above(lines_, first_));
  for (const Row& heading : headings_)
    for (std::size_t c = position_ + 1; c < heading.size(); ++c)
      if (says_percent(heading[c].text)) percent[c - position_ - 1] = true;
  for (std::size_t c = 0; c < percent.size(); ++c) {
    if (percent_cells_[c] == 0) continue;
    if (percent_cells_[c] != contents_.spectra[c].values.size())
      return problem_at(file_, first_row_.front(),
                        "some numbers of column " + std::to_string(position_ + 2 + c) +
                            " have a % behind them, and others have none");
    percent[c] = true;
  }
  if (std::find(percent.begin(), percent.end(), true) == percent.end()) return {};
  contents_.scale = Scale::percent;
  for (std::size_t c = 0; c < percent.size(); ++c) {
    std::vector<double>& values = contents_.spectra[c].values;
    if (percent[c] || values.empty()) continue;
    if (*std::max_element(values.begin(), values.end()) > surely_percent)
      contents_.notes.push_back("column " + std::to_string(position_ + 2 + c) +
                                " is taken for percents, as others say that they are");
    else
      for (double& value : values) value *= 100;
  }
  return {};
}

/// Commas in a table without headings may be decimal ones where all numbers are whole.
void Tall::note_whole_numbers() {
  const std::size_t columns = contents_.spectra.size();
  if (dialect_.delimiter != ',' || columns % 2 == 1 || !headings_.empty()) return;
  for (const RawSpectrum& spectrum : contents_.spectra)
    for (const double value : spectrum.values)
      if (value != std::floor(value)) return;
  contents_.notes.push_back("read as " + std::to_string(columns) +
                            " columns of whole numbers; with decimal commas it would be " +
                            std::to_string(columns / 2) + ", parted by semicolons or tabs");
}

/// Numbers with decimal commas, or commas between thousands, in a table of commas: "400,0,1002" is
/// cut into three cells. Error: what can be nothing else.
Tall::Done Tall::check_commas() const {
  if (dialect_.delimiter != ',' || dialect_.decimal != '.' || first_row_.size() < 3) return {};
  bool all_zero = first_row_.size() % 2 == 1, padded = false;
  for (std::size_t i = first_; i < lines_.all().size(); ++i) {
    const Lines::Line& line = lines_.all()[i];
    const Row row = line.comment ? Row{} : cut(line.text, line.number, dialect_);
    if (!is_row(row, dialect_)) continue;
    for (std::size_t c = 1; c < row.size(); ++c) {
      const std::string_view text = row[c].text;
      all_zero = all_zero && (c % 2 == 0 ? text.find('.') == std::string_view::npos : text == "0");
      padded |= text.size() > 1 && text[0] == '0' && text[1] >= '0' && text[1] <= '9';
    }
  }
  // A heading of half as many cells says it too.
  const std::size_t cells = (first_row_.size() + 1) / 2;
  bool half = false;
  if (first_ > 0 && first_row_.size() % 2 == 1) {
    const Lines::Line& above = lines_.all()[first_ - 1];
    const Row heading = cut(above.text, above.number, dialect_);
    half = !above.comment && heading.size() == cells && cells >= 2;
  }
  if (!all_zero && !padded && !half) return {};
  return problem_at(file_, first_row_[1],
                    "commas part both cells and the digits of numbers; part cells by semicolons or "
                    "tabs, or put numbers into quotes");
}

/// Sekonic's exports have the same lamp twice, by 5 and by 1 nm: the finer one is kept.
void Tall::begin_block(double position) {
  const std::vector<double>& at = contents_.spectra.front().at;
  if (at.empty() || position > at.front()) return;
  if (longer_.empty() || at.size() > longer_.front().at.size()) longer_ = contents_.spectra;
  for (RawSpectrum& spectrum : contents_.spectra) spectrum.at = spectrum.values = {};
}

Tall::Done Tall::read_row(const Row& row) {
  if (row.size() != first_row_.size())
    return problem_at(file_, row.size() < first_row_.size() ? row.back() : row[first_row_.size()],
                      "expected " + std::to_string(first_row_.size()) + " cells as on line " +
                          std::to_string(first_row_.front().line) + ", not " +
                          std::to_string(row.size()));
  const auto position = position_in(row[position_], dialect_);
  if (!position) return no_number(file_, row[position_], dialect_);
  if (position->unit) contents_.unit = position->unit;
  if (labelled_) begin_block(position->value);
  for (std::size_t c = position_ + 1; c < row.size(); ++c) {
    RawSpectrum& spectrum = contents_.spectra[c - position_ - 1];
    if (row[c].text.empty()) {
      ++spectrum.blank;
      continue;
    }
    if (is_percent(row[c])) ++percent_cells_[c - position_ - 1];
    if (spectrum.at.size() == Wavelengths::max_count)
      return problem_at(
          file_, row.front(),
          "at most " + std::to_string(Wavelengths::max_count) + " samples are possible");
    const auto value = number_in(row[c], dialect_);
    if (!value) return no_number(file_, row[c], dialect_);
    if (auto wrong = wrong_next(spectrum.at, position->value))
      return problem_at(file_, row[position_], std::move(*wrong));
    spectrum.at.push_back(position->value);
    spectrum.values.push_back(*value);
  }
  return {};
}

Tall::Done Tall::read_rows() {
  const Lines::Line* remark = nullptr;
  for (std::size_t i = first_; i < lines_.all().size(); ++i) {
    const Lines::Line& line = lines_.all()[i];
    if (line.comment) continue;
    const Row row = cut(line.text, line.number, dialect_);
    // Words may follow the numbers, and stand between rows that are called after wavelengths.
    const bool numeric = position_ < row.size() && position_in(row[position_], dialect_);
    const char begin = row.empty() || row.front().text.empty() ? ' ' : row.front().text.front();
    const bool word =
        !numeric && std::string_view("0123456789.+-").find(begin) == std::string_view::npos;
    if (word && labelled_) continue;
    if (word && remark == nullptr) remark = &line;
    if (word) continue;
    if (remark != nullptr)
      return no_number(file_, cut(remark->text, remark->number, dialect_).front(), dialect_);
    if (Done done = read_row(row); !done) return done;
  }
  return {};
}

std::string Tall::name_of(std::size_t column) const {
  // The line nearest to the data that says more than a unit.
  for (std::size_t i = headings_.size(); i-- > 0;) {
    const std::string_view name = headings_[i][column].text;
    const bool among_units = is_line_of_units(headings_[i], position_ + 1);
    if (!name.empty() && !is_unit(name, among_units)) return std::string(name_in(name));
  }
  return "column " + std::to_string(column + 1);
}

std::string Tall::format() const {
  for (const Lines::Line& line : lines_.all()) {
    if (line.text.find("Begin Spectral Data") != std::string_view::npos) return "OceanView's text";
    if (line.text.find("Spectral Data") != std::string_view::npos && labelled_)
      return "Sekonic's export";
    if (line.number > first_row_.front().line) break;
  }
  const bool pairs = first_row_.size() == 2 && headings_.empty() &&
                     (dialect_.delimiter == ' ' || dialect_.delimiter == '\t');
  return pairs ? "pairs" : "a table with " + describe(dialect_);
}

Result<Contents> Tall::read() {
  if (!find_first_row())
    return problem_at(
        file_, cut(lines_.all().front().text, lines_.all().front().number, dialect_).front(),
        "no spectrum: expected \"from to step\", \"wavelength value\" on each line, a "
        "table, or a CGATS file with BEGIN_DATA");
  if (first_row_.size() < 2)
    return problem_at(file_, first_row_.front(),
                      "expected \"wavelength value\" on each line, but there is no value");
  if (first_row_.size() > max_cells)
    return problem_at(file_, first_row_.front(),
                      "at most " + std::to_string(max_cells) + " columns are possible");
  if (Done done = read_headings(); !done) return tl::unexpected(std::move(done.error()));
  labelled_ = !number_in(first_row_[position_], dialect_);
  if (Done done = check_commas(); !done) return tl::unexpected(std::move(done.error()));
  contents_.spectra.resize(first_row_.size() - position_ - 1);
  percent_cells_.resize(contents_.spectra.size());
  for (RawSpectrum& spectrum : contents_.spectra) spectrum.begin = first_row_.front();
  if (Done done = read_rows(); !done) return tl::unexpected(std::move(done.error()));
  if (longer_.size() > 0 && longer_.front().at.size() > contents_.spectra.front().at.size())
    contents_.spectra = std::move(longer_);
  if (Done done = share_scale(); !done) return tl::unexpected(std::move(done.error()));
  note_whole_numbers();

  // Name them where there are several; columns without a value are none.
  std::vector<RawSpectrum> spectra;
  for (std::size_t c = 0; c < contents_.spectra.size(); ++c) {
    if (contents_.spectra[c].at.empty()) continue;
    spectra.push_back(std::move(contents_.spectra[c]));
    spectra.back().name = name_of(position_ + 1 + c);
  }
  if (spectra.size() == 1 && contents_.spectra.size() == 1) spectra.front().name.clear();
  contents_.spectra = std::move(spectra);
  contents_.format = format();
  if (labelled_ && !contents_.quantity) contents_.quantity = Quantity::emission;
  return std::move(contents_);
}

}  // namespace

Result<Contents> read_tall(const Lines& lines, const Dialect& dialect, const std::string& file) {
  return Tall(lines, dialect, file).read();
}

}  // namespace metamer::spectrum_text
