#include "client/gui/plot/spectrum_plot.h"

#include <qcustomplot.h>

#include <QFileDialog>
#include <QMenu>
#include <QMessageBox>
#include <QToolTip>
#include <QVBoxLayout>
#include <algorithm>

#include "client/gui/plot/plot_style.h"
#include "client/tools/text/csv.h"
#include "common/problem.h"

namespace metamer::gui {
namespace {

constexpr int most_in_legend = 12;

// nm: what is shown of data that go on, as constants do from 1 nm to 10 µm; the rest can be dragged
// into sight.
constexpr double sight_from = 300, sight_to = 850;

/// The data's, as far as it is in first sight; where a curve is not, all of it.
QCPRange wavelength_range(const QList<Curve>& curves) {
  QCPRange all(curves.front().wavelengths.front(), curves.front().wavelengths.back());
  QCPRange seen(sight_from, sight_to);
  for (const Curve& curve : curves) {
    all.lower = std::min(all.lower, curve.wavelengths.front());
    all.upper = std::max(all.upper, curve.wavelengths.back());
  }
  for (const Curve& curve : curves) {
    if (curve.wavelengths.back() < sight_from) seen = all;
    if (curve.wavelengths.front() > sight_to) seen = all;
  }
  seen = {std::max(all.lower, seen.lower), std::min(all.upper, seen.upper)};
  return seen.size() > 0 ? seen : QCPRange(seen.lower - 10, seen.lower + 10);
}

/// From 0, or below where values are, with room above the curves.
QCPRange value_range_of(const QList<Curve>& curves, bool right, const QCPRange& nm) {
  double low = 0, high = 0;
  for (const Curve& curve : curves)
    for (std::size_t i = 0; i < curve.values.size(); ++i)
      if (curve.right == right &&
          (curve.wavelengths.size() <= 2 || nm.contains(curve.wavelengths[i]))) {
        low = std::min(low, curve.values[i]);
        high = std::max(high, curve.values[i]);
      }
  return {low, high > low ? high + 0.04 * (high - low) : low + 1};
}

/// The straight line between two samples; nothing outside them.
std::optional<double> value_at(const Curve& curve, double nm) {
  const auto& all = curve.wavelengths;
  const auto after = std::lower_bound(all.begin(), all.end(), nm);
  if (after == all.end() || (after == all.begin() && *after != nm)) return std::nullopt;
  const auto i = static_cast<std::size_t>(after - all.begin());
  if (i == 0) return curve.values[0];
  const double share = (nm - all[i - 1]) / (all[i] - all[i - 1]);
  return curve.values[i - 1] + share * (curve.values[i] - curve.values[i - 1]);
}

}  // namespace

SpectrumPlot::SpectrumPlot(QWidget* parent) : QWidget(parent), plot_(new QCustomPlot(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(plot_);
  setMinimumSize(200, 140);
  setAccessibleName(tr("Spectra"));
  plot_->xAxis->setLabel(tr("wavelength / nm"));
  plot_->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
  connect(plot_, &QCustomPlot::mouseDoubleClick, this, &SpectrumPlot::fit);
  connect(plot_, &QCustomPlot::mouseMove, this,
          [this](QMouseEvent* event) { tell_values(event->position()); });
  // Below the axes, where it hides no curve.
  plot_->plotLayout()->addElement(1, 0, plot_->legend);
  plot_->plotLayout()->setRowStretchFactor(1, 0.001);
  plot_->legend->setVisible(true);
  plot_->legend->setFillOrder(QCPLegend::foColumnsFirst);
  plot_->legend->setBorderPen(Qt::NoPen);
  // Else the axes would be no wider than the legend, which may be empty.
  plot_->legend->setMaximumSize(QWIDGETSIZE_MAX / 2, QWIDGETSIZE_MAX / 2);
  apply_theme(*plot_, palette());
}

void SpectrumPlot::set_curves(const QList<Curve>& curves, const QString& unit,
                              const QString& right_unit) {
  curves_ = curves;
  plot_->yAxis->setLabel(unit);
  plot_->yAxis2->setLabel(right_unit);
  QStringList names;
  bool right = false;
  for (const Curve& curve : curves_) {
    names << curve.name;
    right = right || curve.right;
  }
  plot_->yAxis2->setVisible(right);
  setAccessibleDescription(tr("%n curves: ", nullptr, static_cast<int>(names.size())) +
                           names.join(QStringLiteral(", ")));
  draw(palette());
  fit();
}

void SpectrumPlot::draw(const QPalette& palette) {
  plot_->clearGraphs();
  apply_theme(*plot_, palette);
  int own = 0;
  QColor last;
  for (const Curve& curve : curves_) {
    QCPGraph* graph = plot_->addGraph(plot_->xAxis, curve.right ? plot_->yAxis2 : plot_->yAxis);
    graph->setName(curve.name);
    QColor color = curve.color;
    if (!color.isValid()) color = curve.dashed && own > 0 ? last : curve_color(own++, palette);
    last = color;
    const bool many = curves_.size() > most_in_legend;
    if (many) graph->removeFromLegend();
    const bool again = own > curve_colors && !many;
    graph->setPen(QPen(color, 1.5,
                       curve.dashed ? Qt::DashLine
                       : again      ? Qt::DotLine
                                    : Qt::SolidLine));
    graph->setData(QVector<double>(curve.wavelengths.begin(), curve.wavelengths.end()),
                   QVector<double>(curve.values.begin(), curve.values.end()), true);
    if (curve.wavelengths.size() == 1) graph->setScatterStyle(QCPScatterStyle::ssDisc);
  }
  wrap_legend();
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

/// As many names beside each other as there is room for.
void SpectrumPlot::wrap_legend() {
  const QFontMetrics metrics(plot_->legend->font());
  int widest = 1;
  for (const Curve& curve : curves_)
    widest = std::max(widest, metrics.horizontalAdvance(curve.name) + 60);
  plot_->legend->setWrap(std::max(1, width() / widest));
  plot_->legend->setFillOrder(QCPLegend::foColumnsFirst, true);
}

void SpectrumPlot::fit() {
  const QCPRange nm = curves_.isEmpty() ? QCPRange(360, 830) : wavelength_range(curves_);
  plot_->xAxis->setRange(nm);
  plot_->yAxis->setRange(value_range_of(curves_, false, nm));
  plot_->yAxis2->setRange(value_range_of(curves_, true, nm));
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

void SpectrumPlot::tell_values(const QPointF& place) {
  const double nm = plot_->xAxis->pixelToCoord(place.x());
  QStringList lines;
  for (const Curve& curve : curves_)
    if (const auto value = value_at(curve, nm))
      lines << QStringLiteral("%1: %2").arg(curve.name).arg(*value, 0, 'g', 4);
  if (lines.isEmpty() || lines.size() > most_in_legend) return QToolTip::hideText();
  lines.prepend(tr("%1 nm").arg(nm, 0, 'f', 1));
  QToolTip::showText(plot_->mapToGlobal(place.toPoint()), lines.join(QLatin1Char('\n')), plot_);
}

QString SpectrumPlot::csv() const {
  std::string text = "curve,nm,value\n";
  for (const Curve& curve : curves_)
    for (std::size_t i = 0; i < curve.values.size(); ++i)
      text += client::csv_field(curve.name.toStdString()) + "," +
              number_text(curve.wavelengths[i]) + "," + number_text(curve.values[i]) + "\n";
  return QString::fromStdString(text);
}

Result<void> SpectrumPlot::save(const QString& file) {
  if (file.endsWith(QStringLiteral(".csv"), Qt::CaseInsensitive)) return save_text(file, csv());
  draw(paper_palette());
  const Result<void> saved = save_plot(*plot_, size(), file);
  draw(palette());
  return saved;
}

void SpectrumPlot::save_as() {
  const QString file = QFileDialog::getSaveFileName(
      this, tr("Save the plot"), {}, tr("PDF (*.pdf);;PNG (*.png);;Numbers (*.csv)"));
  if (file.isEmpty()) return;
  if (const Result<void> saved = save(file); !saved)
    QMessageBox::warning(this, tr("Save the plot"), QString::fromStdString(saved.error().message));
}

void SpectrumPlot::resizeEvent(QResizeEvent*) {
  wrap_legend();
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

void SpectrumPlot::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) draw(palette());
  QWidget::changeEvent(event);
}

void SpectrumPlot::contextMenuEvent(QContextMenuEvent* event) {
  QMenu menu(this);
  menu.addAction(tr("Show &all"), this, &SpectrumPlot::fit);
  menu.addAction(tr("&Save…"), this, &SpectrumPlot::save_as);
  menu.exec(event->globalPos());
}

}  // namespace metamer::gui
