#pragma once

#include <QCheckBox>
#include <QDialog>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPlainTextEdit>
#include <QRadioButton>
#include <QTableWidget>
#include <QTimer>
#include <memory>

#include "client/gui/plot/spectrum_plot.h"
#include "client/gui/spectra/choice_boxes.h"
#include "client/gui/spectra/listed_spectrum.h"
#include "client/tools/spectra/resampled_set.h"

namespace metamer::gui {

/// Spectra at other wavelengths, as a text (4.7.1): before and after in a plot, what falls between
/// the new samples in a table.
class ResampleDialog : public QDialog {
  Q_OBJECT
 public:
  ResampleDialog(const QList<Listed>& rows, const Viewer& viewer, QWidget* parent = nullptr);

  void set_uniform(double from, double to, double step);
  void set_listed(const QString& wavelengths);
  QString text() const { return text_->toPlainText(); }
  SpectrumPlot& plot() { return *plot_; }
  QTableWidget& energies() { return *energies_; }

 Q_SIGNALS:
  /// The text, plot and table are those of what is chosen.
  void shown();

 private:
  using Shown = std::shared_ptr<const client::ResampledSet>;
  QWidget* make_choices(const Viewer& viewer);
  QWidget* make_format();
  Result<Wavelengths> wavelengths() const;
  void ask();
  void show_set(const client::ResampledSet& set);
  void draw(const client::ResampledSet& set);
  void list(const client::ResampledSet& set);
  void tell(const QString& text);
  void refuse(const QString& why);
  void copy();
  void save();

  std::vector<client::LoadedSpectrum> spectra_;
  QTimer quiet_;
  quint64 asked_ = 0;
  QRadioButton *uniform_, *listed_;
  QDoubleSpinBox *from_, *to_, *step_, *luminance_;
  QPlainTextEdit *wavelengths_, *text_;
  QCheckBox *lights_first_, *normalised_;
  ObserverBox* observer_;
  QComboBox* format_;
  SpectrumPlot* plot_;
  QTableWidget* energies_;
  QLabel* told_;
};

}  // namespace metamer::gui
