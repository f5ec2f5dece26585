#pragma once

#include <QColor>
#include <QList>
#include <QString>
#include <QWidget>
#include <vector>

#include "common/problem.h"

class QCustomPlot;

namespace metamer::gui {

/// A function of wavelength (nm) as it is drawn.
struct Curve {
  QString name;
  std::vector<double> wavelengths, values;  ///< As many of each; nm.
  QColor color = {};                        ///< Invalid: the next of the plot's own.
  bool dashed = false;                      ///< Has the colour of the curve before it, if none.
  bool right = false;                       ///< By the right axis, which has its own unit.
};

/// Spectra over wavelength, with a legend. The wheel zooms, a drag shifts, a double click shows all
/// again; a menu saves the plot.
class SpectrumPlot : public QWidget {
  Q_OBJECT
 public:
  explicit SpectrumPlot(QWidget* parent = nullptr);

  /// `right_unit` belongs to the axis of `right` curves.
  void set_curves(const QList<Curve>& curves, const QString& unit, const QString& right_unit = {});
  const QList<Curve>& curves() const { return curves_; }
  void fit();

  /// Into a .pdf, a .png (both as on paper) or a .csv, a line a sample: curve,nm,value. Errors:
  /// another extension; it can't be written.
  Result<void> save(const QString& file);
  QString csv() const;
  /// Asks for a file.
  void save_as();

 protected:
  void changeEvent(QEvent*) override;
  void contextMenuEvent(QContextMenuEvent*) override;
  void resizeEvent(QResizeEvent*) override;

 private:
  void draw(const QPalette& palette);
  void wrap_legend();
  void tell_values(const QPointF& place);

  QCustomPlot* plot_;
  QList<Curve> curves_;
};

}  // namespace metamer::gui
