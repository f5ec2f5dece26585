#pragma once

#include <QAbstractTableModel>
#include <QList>

#include "client/gui/spectra/listed_spectrum.h"

namespace metamer::gui {

/// One of the two lists: lights, or what reflects. A row a spectrum; a light's luminance can be
/// set. Rows are dragged as their words, as text.
class SpectraTable : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum class Kind { lights, materials };
  enum Column { name, kind, range, samples, luminance, least, most, x, y, lights_only };
  /// Lights have these after the common ones, materials L*, a* and b*.
  enum LightColumn { temperature = lights_only, rendering };

  explicit SpectraTable(Kind kind, QObject* parent = nullptr);

  /// Numbers as such, for sorting and for other programs.
  static constexpr int value_role = Qt::UserRole;

  const QList<Listed>& rows() const { return rows_; }
  void set_viewer(const Viewer& viewer) { viewer_ = viewer; }
  /// In place of the one of that word, else at the end.
  void add(const Listed& row);
  /// All of them as another viewer sees them: as many as there are.
  void replace(const QList<Listed>& rows);

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;
  /// Of a luminance: above 0. Else refused() says why not.
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;
  bool removeRows(int row, int count, const QModelIndex& parent = {}) override;
  QStringList mimeTypes() const override;
  QMimeData* mimeData(const QModelIndexList& indexes) const override;

 Q_SIGNALS:
  void refused(const QString& why);

 private:
  QVariant value(const ListedSpectrum& one, int column) const;

  Kind kind_;
  Viewer viewer_ = Viewer::usual();
  QList<Listed> rows_;
};

}  // namespace metamer::gui
