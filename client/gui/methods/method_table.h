#pragma once

#include <QAbstractTableModel>

#include "client/gui/methods/method_rows.h"

namespace metamer::gui {

/// Methods and their figures, a row each.
class MethodTable : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { name, seconds, maximum, percentile_95, mean, bound, came, columns };
  using QAbstractTableModel::QAbstractTableModel;

  void set_rows(const QList<MethodRow>& rows, const std::vector<bool>& front);
  const QList<MethodRow>& rows() const { return rows_; }

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

  /// Of data(): numbers as numbers, to sort by.
  static constexpr int sort_role = Qt::UserRole;

 private:
  QString text(int row, int column) const;
  QVariant number(const MethodRow& row, int column) const;

  QList<MethodRow> rows_;
  std::vector<bool> front_;
};

}  // namespace metamer::gui
