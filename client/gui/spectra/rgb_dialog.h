#pragma once

#include <QCheckBox>
#include <QDialog>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QTableView>
#include <vector>

#include "client/gui/spectra/choice_boxes.h"
#include "client/gui/spectra/listed_spectrum.h"
#include "client/gui/spectra/rgb_table.h"

namespace metamer::gui {

/// Trichromatic values of spectra (4.7.1): by which observer, in which space, adapted how.
class RgbDialog : public QDialog {
  Q_OBJECT
 public:
  RgbDialog(const QList<Listed>& rows, const Viewer& viewer, QWidget* parent = nullptr);

  RgbTable& table() { return table_; }
  /// As the command line has them: "display-p3"; "" for no adaptation.
  void set_space(const QString& word);
  void set_adaptation(const QString& word);

 Q_SIGNALS:
  /// The table is that of what is chosen.
  void shown();

 private:
  QWidget* make_choices(const Viewer& viewer);
  QWidget* make_buttons();
  v1::Development development() const;
  void ask();
  void copy();
  void save();

  std::vector<client::LoadedSpectrum> spectra_;
  RgbTable table_;
  quint64 asked_ = 0;
  ObserverBox* observer_;
  SpectrumBox* light_;
  QDoubleSpinBox* luminance_;
  QComboBox *space_, *adaptation_;
  QCheckBox* linear_;
  QTableView* view_;
  QLabel* told_;
};

}  // namespace metamer::gui
