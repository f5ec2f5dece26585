#include "client/gui/plot/scatter_plot.h"

#include <qcustomplot.h>

#include <QFileDialog>
#include <QMenu>
#include <QMessageBox>
#include <QMouseEvent>
#include <QToolTip>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "client/gui/plot/plot_style.h"
#include "client/tools/text/csv.h"

namespace metamer::gui {
namespace {

constexpr double reach = 9;        // pixels: how near a click has to be
constexpr double level_reach = 5;  // pixels

}  // namespace

ScatterPlot::ScatterPlot(QWidget* parent) : QWidget(parent), plot_(new QCustomPlot(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(plot_);
  setMinimumSize(320, 180);
  setAccessibleName(tr("Plot"));
  plot_->setFocusPolicy(Qt::NoFocus);
  plot_->setMouseTracking(true);
  plot_->installEventFilter(this);
  plot_->setAutoAddPlottableToLegend(true);
  plot_->plotLayout()->addElement(1, 0, plot_->legend);
  plot_->plotLayout()->setRowStretchFactor(1, 0.001);
  plot_->legend->setVisible(true);
  plot_->legend->setFillOrder(QCPLegend::foColumnsFirst);
  plot_->legend->setIconSize(20, 16);
  plot_->legend->setIconTextPadding(4);
  plot_->legend->setBorderPen(Qt::NoPen);
  plot_->legend->setMaximumSize(QWIDGETSIZE_MAX / 2, QWIDGETSIZE_MAX / 2);
  connect(plot_, &QCustomPlot::afterLayout, this, &ScatterPlot::place_names);
  draw(palette());
}

void ScatterPlot::set_axes(const QString& x, const QString& y, const QStringList& families) {
  plot_->xAxis->setLabel(x);
  plot_->yAxis->setLabel(y);
  families_ = families;
}

void ScatterPlot::set_points(const QList<ScatterPoint>& points, double floor) {
  points_ = points;
  floor_ = floor;
  pressed_ = -1;
  if (current_ >= points_.size()) current_ = -1;
  scale_axes();
  draw(palette());
}

void ScatterPlot::set_level(const std::optional<double>& level, const QString& name, bool solid) {
  level_ = level;
  level_name_ = name;
  level_counts_ = solid;
  scale_axes();
  draw(palette());
}

void ScatterPlot::set_current(int point) {
  current_ = point;
  draw(palette());
}

/// Who drags the level has firm ground.
void ScatterPlot::scale_axes() {
  if (dragging_) return;
  QList<double> xs, ys;
  for (const ScatterPoint& one : points_) {
    xs << one.x;
    ys << one.y << std::max(one.y, one.whisker);
  }
  if (level_ && !ys.isEmpty()) ys << *level_;
  x_ = axis_scale(xs, 1e-9);
  y_ = axis_scale(ys, floor_ > 0 ? floor_ : 1e-9);
}

QPointF ScatterPlot::shown(const ScatterPoint& point) const {
  return {point.x, std::max(point.y, floor_)};
}

QPointF ScatterPlot::pixel(const QPointF& point) const {
  return {plot_->xAxis->coordToPixel(point.x()), plot_->yAxis->coordToPixel(point.y())};
}

int ScatterPlot::point_at(const QPointF& place) const {
  int nearest = -1;
  double least = reach;
  for (int i = 0; i < points_.size(); ++i) {
    const QPointF apart = pixel(shown(points_[i])) - place;
    const double distance = std::hypot(apart.x(), apart.y());
    if (distance > least) continue;
    least = distance;
    nearest = i;
  }
  return nearest;
}

bool ScatterPlot::is_on_level(const QPointF& place) const {
  return level_ && plot_->axisRect()->rect().contains(place.toPoint()) &&
         std::abs(plot_->yAxis->coordToPixel(*level_) - place.y()) <= level_reach;
}

/// To three digits, within the axis.
double ScatterPlot::level_at(const QPointF& place) const {
  const double level = std::clamp(plot_->yAxis->pixelToCoord(place.y()), y_.from, y_.to);
  return QString::number(level, 'g', 3).toDouble();
}

QPoint ScatterPlot::place_of(int point) const {
  return plot_->mapTo(this, pixel(shown(points_[point])).toPoint());
}

QPoint ScatterPlot::place_of_level() const {
  return plot_->mapTo(this, QPoint(plot_->axisRect()->left() + 3,
                                   static_cast<int>(plot_->yAxis->coordToPixel(*level_))));
}

bool ScatterPlot::eventFilter(QObject* watched, QEvent* event) {
  const auto place = [&] { return static_cast<QMouseEvent*>(event)->position(); };
  const auto left = [&] { return static_cast<QMouseEvent*>(event)->button() == Qt::LeftButton; };
  switch (event->type()) {
    case QEvent::MouseButtonPress:
      if (!left()) break;
      pressed_ = point_at(place());
      dragging_ = pressed_ < 0 && is_on_level(place());
      break;
    case QEvent::MouseMove:
      move_mouse(place());
      break;
    case QEvent::MouseButtonRelease:
      if (!left()) break;
      if (std::exchange(dragging_, false))
        Q_EMIT level_dropped(level_at(place()));
      else if (const int at = std::exchange(pressed_, -1); at >= 0 && at == point_at(place()))
        Q_EMIT clicked(at);
      break;
    default:
      break;
  }
  return QWidget::eventFilter(watched, event);
}

void ScatterPlot::move_mouse(const QPointF& place) {
  if (dragging_) return Q_EMIT level_dragged(level_at(place));
  const int at = point_at(place);
  plot_->setCursor(at >= 0              ? Qt::PointingHandCursor
                   : is_on_level(place) ? Qt::SplitVCursor
                                        : Qt::ArrowCursor);
  if (at < 0) return QToolTip::hideText();
  const ScatterPoint& one = points_[at];
  QString text = QStringLiteral("%1\n%2: %3\n%4: %5")
                     .arg(one.name, plot_->xAxis->label(), QString::number(one.x, 'g', 4),
                          plot_->yAxis->label(), QString::number(one.y, 'g', 3));
  if (one.came)
    text +=
        tr("\ncame: %1, %2")
            .arg(QString::number(one.came->x(), 'g', 4), QString::number(one.came->y(), 'g', 3));
  QToolTip::showText(plot_->mapToGlobal(place.toPoint()), text, plot_);
}

QString ScatterPlot::csv() const {
  std::string text = client::csv_field(plot_->xAxis->label().toStdString()) + "," +
                     client::csv_field(plot_->yAxis->label().toStdString());
  text = "name," + text + ",upper,front\n";
  for (const ScatterPoint& one : points_)
    text += client::csv_field(one.name.toStdString()) + "," + number_text(one.x) + "," +
            number_text(one.y) + "," + number_text(std::max(one.y, one.whisker)) +
            (one.front ? ",1\n" : ",0\n");
  return QString::fromStdString(text);
}

Result<void> ScatterPlot::save(const QString& file) {
  if (file.endsWith(QStringLiteral(".csv"), Qt::CaseInsensitive)) return save_text(file, csv());
  draw(paper_palette());
  const Result<void> saved = save_plot(*plot_, size(), file);
  draw(palette());
  return saved;
}

void ScatterPlot::save_as() {
  const QString file = QFileDialog::getSaveFileName(
      this, tr("Save the plot"), {}, tr("PDF (*.pdf);;PNG (*.png);;Numbers (*.csv)"));
  if (file.isEmpty()) return;
  if (const Result<void> saved = save(file); !saved)
    QMessageBox::warning(this, tr("Save the plot"), QString::fromStdString(saved.error().message));
}

void ScatterPlot::resizeEvent(QResizeEvent*) {
  wrap_legend();
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

void ScatterPlot::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) draw(palette());
  QWidget::changeEvent(event);
}

void ScatterPlot::contextMenuEvent(QContextMenuEvent* event) {
  QMenu menu(this);
  menu.addAction(tr("&Save…"), this, &ScatterPlot::save_as);
  menu.exec(event->globalPos());
}

}  // namespace metamer::gui
