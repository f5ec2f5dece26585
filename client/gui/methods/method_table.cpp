#include "client/gui/methods/method_table.h"

#include <QFont>

namespace metamer::gui {

void MethodTable::set_rows(const QList<MethodRow>& rows, const std::vector<bool>& front) {
  // The rows that are there stay chosen where they only say something new.
  const bool same =
      rows.size() == rows_.size() &&
      std::equal(rows.begin(), rows.end(), rows_.begin(),
                 [](const MethodRow& a, const MethodRow& b) { return a.name == b.name; });
  if (!same) beginResetModel();
  rows_ = rows;
  front_ = front;
  if (!same)
    endResetModel();
  else if (!rows_.isEmpty())
    Q_EMIT dataChanged(index(0, 0), index(rowCount() - 1, columns - 1));
}

int MethodTable::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

int MethodTable::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : columns;
}

QVariant MethodTable::number(const MethodRow& row, int column) const {
  switch (static_cast<Column>(column)) {
    case seconds:
      return row.seconds;
    case maximum:
      return row.error.maximum;
    case percentile_95:
      return row.error.percentile_95;
    case mean:
      return row.error.mean;
    case bound:
      return row.bound ? QVariant(*row.bound) : QVariant();
    case name:
    case came:
    case columns:
      break;
  }
  return {};
}

QString MethodTable::text(int at, int column) const {
  const MethodRow& row = rows_[at];
  if (column == name) return row.chosen ? tr("● %1").arg(row.name) : row.name;
  if (!row.failure.isEmpty()) return column == came ? row.failure : QStringLiteral("-");
  if (column == came) {
    if (!row.came) return {};
    const QString seconds = tr("%1 s").arg(row.came->seconds, 0, 'g', 4);
    return row.came->error ? tr("%1, ΔE00 at most %2, %3")
                                 .arg(seconds)
                                 .arg(row.came->error->maximum, 0, 'g', 3)
                                 .arg(row.came->from)
                           : tr("%1, %2").arg(seconds, row.came->from);
  }
  const QVariant value = number(row, column);
  return value.isNull() ? QStringLiteral("-")
                        : QString::number(value.toDouble(), 'g', column == seconds ? 4 : 3);
}

QVariant MethodTable::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  const MethodRow& row = rows_[index.row()];
  const bool is_number = index.column() != name && index.column() != came;
  if (role == Qt::TextAlignmentRole && is_number)
    return static_cast<int>(Qt::AlignRight | Qt::AlignVCenter);
  if (role == Qt::FontRole && front_[static_cast<std::size_t>(index.row())]) {
    QFont bold;
    bold.setBold(true);
    return bold;
  }
  if (role == sort_role) {
    const QVariant value = number(row, index.column());
    // What failed or is not known stands behind all numbers.
    if (is_number) return row.failure.isEmpty() && !value.isNull() ? value : QVariant(1e300);
    return index.column() == name ? row.name : text(index.row(), came);
  }
  if (role == Qt::DisplayRole) return text(index.row(), index.column());
  if (role != Qt::ToolTipRole) return {};
  QString tip = row.failure.isEmpty() ? text(index.row(), index.column()) : row.failure;
  if (row.chosen) tip += tr("\n●: it is used");
  if (front_[static_cast<std::size_t>(index.row())])
    tip += tr("\nOn the Pareto front: no other is both quicker and more accurate.");
  return tip;
}

QVariant MethodTable::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || (role != Qt::DisplayRole && role != Qt::ToolTipRole))
    return {};
  const bool tip = role == Qt::ToolTipRole;
  switch (static_cast<Column>(section)) {
    case name:
      return tip ? tr("bold: on the Pareto front; ●: it is used") : tr("Method");
    case seconds:
      return tip ? tr("for its tables and the whole picture") : tr("Seconds");
    case maximum:
      return tip ? tr("ΔE00 against the reference, the largest") : tr("Largest");
    case percentile_95:
      return tip ? tr("ΔE00: 95 % of the pixels are off by no more") : tr("95 %");
    case mean:
      return tip ? tr("ΔE00, on average") : tr("Mean");
    case bound:
      return tip ? tr("the largest ΔE00 of one light on one surface that faces it, in the picture "
                      "or not")
                 : tr("Any color");
    case came:
      return tip ? tr("what came of it when it was used, or why it failed") : tr("Came");
    case columns:
      break;
  }
  return {};
}

}  // namespace metamer::gui
