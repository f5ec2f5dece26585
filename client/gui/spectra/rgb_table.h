#pragma once

#include <QAbstractTableModel>
#include <QList>
#include <string>

#include "client/tools/spectra/spectrum_rgb.h"

namespace metamer::gui {

/// A spectrum's trichromatic values.
struct RgbRow {
  QString label;
  client::SpectrumRgb rgb;
};

/// A row a spectrum: X Y Z, linear and encoded R G B, whether it is in the space's gamut.
class RgbTable : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { name, xyz, linear = xyz + 3, encoded = linear + 3, gamut = encoded + 3, columns };

  using QAbstractTableModel::QAbstractTableModel;
  static constexpr int value_role = Qt::UserRole;

  const QList<RgbRow>& rows() const { return rows_; }
  void set_rows(const QList<RgbRow>& rows);
  /// With its headings, apart by tabs.
  QString text() const;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  QList<RgbRow> rows_;
};

}  // namespace metamer::gui
