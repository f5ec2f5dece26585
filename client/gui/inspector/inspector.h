#pragma once

#include <QBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QTableView>
#include <QWidget>

#include "client/gui/inspector/pin_table.h"
#include "client/gui/plot/spectrum_plot.h"

namespace metamer::gui {

/// What is under the cursor, in numbers and spectra, and the pins: spots that are kept.
class Inspector : public QWidget {
  Q_OBJECT
 public:
  explicit Inspector(QWidget* parent = nullptr);

  /// Nothing: the cursor is in no picture.
  void show_spot(const std::optional<Spot>& spot);
  const std::optional<Spot>& spot() const { return spot_; }
  /// Why there are no spectra, object and material: of an older server, say.
  void show_missing(const QString& why);
  /// Keeps the spot that is shown. False: its colour is not known.
  bool pin();

  int side() const { return side_->value(); }
  PinTable& pins() { return *pins_; }
  QTableView& table() { return *table_; }

 Q_SIGNALS:
  void side_changed();
  /// The name of what is met was clicked.
  void object_clicked(const QString& name);
  void pins_changed();

 protected:
  void resizeEvent(QResizeEvent*) override;

 private:
  QWidget* make_spot();
  QWidget* make_pins();
  void show_pair();
  void save();

  std::optional<Spot> spot_;
  QLabel *place_, *object_, *color_, *missing_, *pair_;
  QLabel* chip_;
  QBoxLayout* parts_;
  QSpinBox* side_;
  SpectrumPlot *light_plot_, *surface_plot_;
  PinTable* pins_;
  QTableView* table_;
};

}  // namespace metamer::gui
