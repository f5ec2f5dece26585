#pragma once

#include <QDialog>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>

#include "client/gui/plot/spectrum_plot.h"
#include "client/gui/spectra/choice_boxes.h"
#include "client/gui/spectra/listed_spectrum.h"
#include "client/gui/spectra/metamer_maker.h"

namespace metamer::gui {

/// A reflectance that looks like another under one light and not under another: both curves, and
/// how far they are apart under the CIE's illuminants.
class MetamerDialog : public QDialog {
  Q_OBJECT
 public:
  /// `original` may be null: TCS05 then.
  MetamerDialog(const Listed& original, const Viewer& viewer, QWidget* parent = nullptr);

  void make();
  QTableWidget& table() { return *table_; }
  SpectrumPlot& plot() { return *plot_; }
  QString told() const { return told_->text(); }

 Q_SIGNALS:
  /// One was made, or none can be.
  void shown();
  void saved(const QString& file);

 private:
  QWidget* make_choices(const Viewer& viewer);
  QWidget* make_buttons();
  void take(const std::shared_ptr<const MadeMetamer>& metamer);
  void refuse(const QString& why);
  void save();

  Listed given_;
  MetamerMaker maker_;
  std::shared_ptr<const MadeMetamer> made_;
  SpectrumBox *original_, *under_, *against_;
  ObserverBox* observer_;
  SpectrumPlot* plot_;
  QTableWidget* table_;
  QLabel* told_;
  QPushButton *make_, *save_;
};

}  // namespace metamer::gui
