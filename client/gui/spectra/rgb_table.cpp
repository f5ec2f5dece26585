#include "client/gui/spectra/rgb_table.h"

#include <QPainter>
#include <QPixmap>
#include <algorithm>

namespace metamer::gui {
namespace {

double rgb_value(const client::SpectrumRgb& rgb, int column) {
  const auto at = [&](int first) { return static_cast<std::size_t>(column - first); };
  if (column < RgbTable::linear) return rgb.xyz[at(RgbTable::xyz)];
  if (column < RgbTable::encoded) return rgb.linear[at(RgbTable::linear)];
  return rgb.encoded[at(RgbTable::encoded)];
}

/// What the numbers look like where the screen takes them for its own.
QPixmap swatch(const client::SpectrumRgb& rgb) {
  const auto part = [](double value) { return static_cast<float>(std::clamp(value, 0.0, 1.0)); };
  QPixmap image(14, 14);
  image.fill(Qt::gray);
  QPainter(&image).fillRect(
      1, 1, 12, 12,
      QColor::fromRgbF(part(rgb.encoded[0]), part(rgb.encoded[1]), part(rgb.encoded[2])));
  return image;
}

}  // namespace

void RgbTable::set_rows(const QList<RgbRow>& rows) {
  beginResetModel();
  rows_ = rows;
  endResetModel();
}

int RgbTable::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

int RgbTable::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(columns);
}

QVariant RgbTable::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  const RgbRow& row = rows_[index.row()];
  const int column = index.column();
  const bool is_number = column >= xyz && column < gamut;
  switch (role) {
    case Qt::DisplayRole:
      if (column == name) return row.label;
      if (column == gamut) return row.rgb.in_gamut ? tr("✓ in gamut") : tr("✗ out of gamut");
      return QString::number(rgb_value(row.rgb, column), 'f', 5);
    case value_role:
      if (is_number) return rgb_value(row.rgb, column);
      return column == name ? QVariant(row.label) : QVariant(row.rgb.in_gamut);
    case Qt::DecorationRole:
      return column == name ? QVariant(swatch(row.rgb)) : QVariant();
    case Qt::TextAlignmentRole:
      return QVariant(Qt::AlignVCenter | (is_number ? Qt::AlignRight : Qt::AlignLeft));
    default:
      return {};
  }
}

QVariant RgbTable::headerData(int section, Qt::Orientation orientation, int role) const {
  static const QStringList headings{tr("Spectrum"), tr("X"),        tr("Y"),        tr("Z"),
                                    tr("R linear"), tr("G linear"), tr("B linear"), tr("R"),
                                    tr("G"),        tr("B"),        tr("Gamut")};
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
  return section >= 0 && section < headings.size() ? QVariant(headings[section]) : QVariant();
}

QString RgbTable::text() const {
  QStringList lines, fields;
  for (int column = 0; column < columns; ++column)
    fields << headerData(column, Qt::Horizontal, Qt::DisplayRole).toString();
  lines << fields.join(QLatin1Char('\t'));
  for (int row = 0; row < rowCount(); ++row) {
    fields.clear();
    for (int column = 0; column < columns; ++column)
      fields << data(index(row, column), Qt::DisplayRole).toString();
    lines << fields.join(QLatin1Char('\t'));
  }
  return lines.join(QLatin1Char('\n')) + QLatin1Char('\n');
}

}  // namespace metamer::gui
