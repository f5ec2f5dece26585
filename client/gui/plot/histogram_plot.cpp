#include "client/gui/plot/histogram_plot.h"

#include <qcustomplot.h>

#include <QVBoxLayout>
#include <algorithm>

#include "client/gui/plot/plot_style.h"

namespace metamer::gui {

HistogramPlot::HistogramPlot(QWidget* parent) : QWidget(parent), plot_(new QCustomPlot(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(plot_);
  setMinimumSize(220, 110);
  setAccessibleName(tr("Histogram of differences"));
  draw();
}

void HistogramPlot::set_histogram(const std::vector<std::size_t>& counts, double top,
                                  const QString& unit, const std::optional<double>& limit) {
  counts_ = counts;
  top_ = top;
  unit_ = unit;
  limit_ = limit;
  setAccessibleDescription(tr("%1 from 0 to %2 in %3 bins").arg(unit).arg(top).arg(counts.size()));
  draw();
}

void HistogramPlot::draw() {
  plot_->clearPlottables();
  plot_->clearItems();
  apply_theme(*plot_, palette());
  plot_->xAxis->setLabel(unit_);
  plot_->yAxis->setLabel(tr("pixels"));
  plot_->yAxis->setNumberFormat(QStringLiteral("gb"));
  const auto bins = static_cast<double>(std::max<std::size_t>(1, counts_.size()));
  const double width = top_ / bins;
  auto* bars = new QCPBars(plot_->xAxis, plot_->yAxis);
  bars->setWidth(width);
  bars->setPen(Qt::NoPen);
  bars->setBrush(curve_color(0, palette()));
  double most = 1;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    const auto count = static_cast<double>(counts_[i]);
    bars->addData((static_cast<double>(i) + 0.5) * width, count);
    most = std::max(most, count);
  }
  if (limit_) {
    auto* line = new QCPItemStraightLine(plot_);
    line->point1->setCoords(*limit_, 0);
    line->point2->setCoords(*limit_, 1);
    line->setPen(QPen(curve_color(1, palette()), 1.5, Qt::DashLine));
  }
  plot_->xAxis->setRange(0, top_);
  plot_->yAxis->setRange(0, 1.05 * most);
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

void HistogramPlot::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) draw();
  QWidget::changeEvent(event);
}

}  // namespace metamer::gui
