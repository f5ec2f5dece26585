#pragma once

#include <QAbstractTableModel>
#include <QString>
#include <vector>

#include "common/problem.h"

namespace metamer::gui {

/// Problems of a scene as rows: the place, the field, the sentence, and what mends it.
class ProblemTable : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { place, field, sentence, fix, columns };

  using QAbstractTableModel::QAbstractTableModel;

  /// `own` is the scene's file as its problems name it: places in it need no name.
  void set_problems(std::vector<Problem> problems, const QString& own);
  const std::vector<Problem>& problems() const { return problems_; }

  /// The row after a place of `file` (before it: `backwards`), in the table's order; goes on at the
  /// other end. -1: there are none.
  int next(const QString& file, int line, int column, bool backwards) const;

  /// What can be done about one, for a button: "Write red", "Locate…"; empty: nothing. Of the
  /// scene's own alone.
  QString fix_text(int row) const;
  /// The row with a fix that is on a line of the scene and nearest to a column; -1: there is none.
  int fix_at(int line, int column) const;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  QString place_text(const Problem& problem) const;

  std::vector<Problem> problems_;  ///< The scene's own first, from its top; then by file and line.
  QString own_;
};

}  // namespace metamer::gui
