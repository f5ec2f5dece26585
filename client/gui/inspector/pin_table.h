#pragma once

#include <QAbstractTableModel>

#include "client/gui/inspector/pin.h"

namespace metamer::gui {

/// The pins, a row each.
class PinTable : public QAbstractTableModel {
  Q_OBJECT
 public:
  using QAbstractTableModel::QAbstractTableModel;

  /// Numbers go on from the largest there was.
  const Pin& add(Spot spot);
  void remove(const QModelIndexList& rows);
  const QList<Pin>& pins() const { return pins_; }

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  QList<Pin> pins_;
  int last_ = 0;
};

}  // namespace metamer::gui
