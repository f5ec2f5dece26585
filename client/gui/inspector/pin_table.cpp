#include "client/gui/inspector/pin_table.h"

#include <array>
#include <functional>
#include <set>
#include <utility>

namespace metamer::gui {
namespace {

namespace column {
enum { number, object, x, y, z, l, a, b, place, count };
}

QString cell_text(const client::PixelReading& color, int at) {
  if (at <= column::z)
    return QString::number(color.xyz[static_cast<std::size_t>(at - column::x)], 'f', 4);
  if (!color.lab) return {};
  const std::array lab{color.lab->l, color.lab->a, color.lab->b};
  return QString::number(lab[static_cast<std::size_t>(at - column::l)], 'f', 2);
}

}  // namespace

const Pin& PinTable::add(Spot spot) {
  const int row = static_cast<int>(pins_.size());
  beginInsertRows({}, row, row);
  pins_ << Pin{++last_, std::move(spot)};
  endInsertRows();
  return pins_.back();
}

void PinTable::remove(const QModelIndexList& rows) {
  std::set<int, std::greater<>> gone;
  for (const QModelIndex& index : rows) gone.insert(index.row());
  for (const int row : gone) {
    beginRemoveRows({}, row, row);
    pins_.removeAt(row);
    endRemoveRows();
  }
}

int PinTable::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(pins_.size());
}

int PinTable::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : column::count;
}

QVariant PinTable::data(const QModelIndex& index, int role) const {
  if (!checkIndex(index, CheckIndexOption::IndexIsValid)) return {};
  const Pin& pin = pins_[index.row()];
  if (role == Qt::DecorationRole && index.column() == column::number) return chip_of(pin.spot);
  if (role != Qt::DisplayRole) return {};
  switch (index.column()) {
    case column::number:
      return pin.number;
    case column::object:
      return QString::fromStdString(pin.spot.probed.object());
    case column::place:
      return QStringLiteral("%1 (%2, %3)")
          .arg(pin.spot.from)
          .arg(pin.spot.pixel.x())
          .arg(pin.spot.pixel.y());
    default:
      return pin.spot.color ? cell_text(*pin.spot.color, index.column()) : QString();
  }
}

QVariant PinTable::headerData(int section, Qt::Orientation orientation, int role) const {
  if (role != Qt::DisplayRole || orientation != Qt::Horizontal) return {};
  const QStringList names{
      tr("Pin"),           tr("Object"),         QStringLiteral("X"),  QStringLiteral("Y"),
      QStringLiteral("Z"), QStringLiteral("L*"), QStringLiteral("a*"), QStringLiteral("b*"),
      tr("Place")};
  return names.value(section);
}

}  // namespace metamer::gui
