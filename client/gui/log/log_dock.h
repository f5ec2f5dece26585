#pragma once

#include <QCheckBox>
#include <QLineEdit>
#include <QPushButton>
#include <QSortFilterProxyModel>
#include <QTableView>
#include <QWidget>

#include "client/gui/log/log.h"

namespace metamer::gui {

/// The lines that somebody wants to see.
class LogFilter : public QSortFilterProxyModel {
  Q_OBJECT
 public:
  explicit LogFilter(Log& log, QObject* parent = nullptr);
  void set_words(const QString& words);
  /// Warnings and errors alone.
  void set_no_notes(bool no_notes);

 protected:
  /// All words stand somewhere in the line.
  bool filterAcceptsRow(int row, const QModelIndex& parent) const override;

 private:
  Log& log_;
  QStringList words_;
  bool no_notes_ = false;
};

/// The window's log, the newest at the bottom, which stays in sight where it was.
class LogDock : public QWidget {
  Q_OBJECT
 public:
  explicit LogDock(Log& log, QWidget* parent = nullptr);

  QTableView& view() { return *view_; }
  QLineEdit& words() { return *words_; }
  QCheckBox& no_notes() { return *no_notes_; }
  /// The lines that are chosen, else all that are shown, into the clipboard.
  void copy() const;

 protected:
  void showEvent(QShowEvent*) override;

 private:
  Log& log_;
  LogFilter filter_;
  QTableView* view_;
  QLineEdit* words_;
  QCheckBox* no_notes_;
  bool at_end_ = true;
};

}  // namespace metamer::gui
