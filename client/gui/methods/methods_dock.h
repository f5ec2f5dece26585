#pragma once

#include <QComboBox>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSortFilterProxyModel>
#include <QSpinBox>
#include <QTableView>
#include <QWidget>

#include "client/gui/app/number_box.h"
#include "client/gui/methods/method_table.h"

namespace metamer::gui {

/// What each method costs on the scene, and how far it is off: a plot and a table. A click on a
/// point, or Enter in the table, asks for the method; a tolerance is dragged or typed.
class MethodsDock : public QWidget {
  Q_OBJECT
 public:
  explicit MethodsDock(QWidget* parent = nullptr);

  /// Before anything is known.
  static QString first_heading();
  /// `heading` says what they are of. `tolerance`: the scene's goal; nothing: it has no such goal.
  void show_rows(const QList<MethodRow>& rows, const QString& heading,
                 const std::optional<double>& tolerance);
  /// Something to be known, below the heading; empty: nothing.
  void show_note(const QString& note);
  /// A measurement is under way; 0 of 0: none is.
  void show_progress(unsigned job, unsigned jobs, const QString& method);
  void set_can_save(bool can) { save_->setEnabled(can); }

  const QList<MethodRow>& rows() const { return table_.rows(); }
  ScatterPlot& plot() { return *plot_; }
  QTableView& view() { return *view_; }
  NumberBox& tolerance() { return *tolerance_; }
  QComboBox& figure() { return *figure_; }
  QSpinBox& rounds() { return *rounds_; }
  unsigned chosen_rounds() const { return static_cast<unsigned>(rounds_->value()); }
  QPushButton& measure_button() { return *measure_; }
  QPushButton& cancel_button() { return *cancel_; }
  QString heading() const { return heading_->text(); }
  QString note() const { return note_->text(); }

 Q_SIGNALS:
  void explain_asked();
  void measure_asked(unsigned rounds);
  void cancel_asked();
  void save_asked();
  void method_asked(const v1::Method& method);
  void tolerance_asked(double tolerance);

 private:
  void make_layout();
  void choose(int row);
  void show_figure();
  void show_under(double tolerance);
  ErrorFigure shown_figure() const;

  MethodTable table_;
  QSortFilterProxyModel sorted_;
  ScatterPlot* plot_;
  QTableView* view_;
  QLabel *heading_, *note_;
  QComboBox* figure_;
  NumberBox* tolerance_;
  QSpinBox* rounds_;
  QPushButton *explain_, *measure_, *cancel_, *save_;
  QProgressBar* bar_;
  std::optional<double> goal_;
};

}  // namespace metamer::gui
