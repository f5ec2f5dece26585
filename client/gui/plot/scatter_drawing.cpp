// How a scatter plot is drawn.
#include <qcustomplot.h>

#include <algorithm>

#include "client/gui/plot/plot_style.h"
#include "client/gui/plot/scatter_names.h"
#include "client/gui/plot/scatter_plot.h"

namespace metamer::gui {
namespace {

constexpr double mark_size = 8, ring_size = 15, frame_size = 21;  // pixels
constexpr int faint_alpha = 80;

QCPScatterStyle::ScatterShape shape_of(int family) {
  static constexpr QCPScatterStyle::ScatterShape shapes[] = {
      QCPScatterStyle::ssDisc,     QCPScatterStyle::ssSquare,           QCPScatterStyle::ssDiamond,
      QCPScatterStyle::ssTriangle, QCPScatterStyle::ssTriangleInverted, QCPScatterStyle::ssStar};
  return shapes[static_cast<std::size_t>(family) % std::size(shapes)];
}

/// Points without a line.
QCPGraph* add_marks(QCustomPlot& plot, const QCPScatterStyle& style) {
  QCPGraph* graph = plot.addGraph();
  graph->setLineStyle(QCPGraph::lsNone);
  graph->setScatterStyle(style);
  graph->removeFromLegend();
  return graph;
}

void set_scale(QCPAxis& axis, const AxisScale& scale) {
  axis.setScaleType(scale.logarithmic ? QCPAxis::stLogarithmic : QCPAxis::stLinear);
  axis.setRange(scale.from, scale.to);
  if (scale.logarithmic) {
    const auto ticker = QSharedPointer<QCPAxisTickerText>::create();
    ticker->setTicks(log_ticks(scale));
    axis.setTicker(ticker);
  } else {
    axis.setTicker(QSharedPointer<QCPAxisTicker>::create());
  }
}

}  // namespace

void ScatterPlot::draw(const QPalette& palette) {
  plot_->clearPlottables();
  plot_->clearItems();
  names_.clear();
  set_scale(*plot_->xAxis, x_);
  set_scale(*plot_->yAxis, y_);
  apply_theme(*plot_, palette);
  draw_front(palette);
  draw_points(palette);
  draw_marks(palette);
  draw_level(palette);
  wrap_legend();
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

/// As many names beside each other as there is room for.
void ScatterPlot::wrap_legend() {
  const QFontMetrics metrics(plot_->legend->font());
  int widest = 1;
  for (int i = 0; i < plot_->legend->itemCount(); ++i)
    if (auto* item = qobject_cast<QCPPlottableLegendItem*>(plot_->legend->item(i)))
      widest = std::max(widest, metrics.horizontalAdvance(item->plottable()->name()) + 40);
  plot_->legend->setWrap(std::max(1, width() / widest));
  plot_->legend->setFillOrder(QCPLegend::foColumnsFirst, true);
}

void ScatterPlot::draw_front(const QPalette& palette) {
  const QColor ink = palette.color(QPalette::Text);
  QCPGraph* line = plot_->addGraph();
  line->setName(tr("Pareto front"));
  line->setPen(QPen(ink, 1.2));
  if (points_.isEmpty()) line->removeFromLegend();
  for (int i = 0; i < points_.size(); ++i) {
    if (!points_[i].front) continue;
    line->addData(points_[i].x, shown(points_[i]).y());
    auto* text = new QCPItemText(plot_);
    text->setText(points_[i].name);
    text->setColor(ink);
    names_.emplace_back(i, text);
  }
}

/// A graph for each family, once as it is and once faint; the whiskers are its error bars.
void ScatterPlot::draw_points(const QPalette& palette) {
  for (int family = 0; family < families_.size(); ++family) {
    for (const bool faint : {true, false}) {
      QColor color = curve_color(family, palette);
      if (faint) color.setAlpha(faint_alpha);
      QCPScatterStyle style(shape_of(family), QPen(color, 1.5), QBrush(color), mark_size);
      QCPGraph* graph = add_marks(*plot_, style);
      graph->setName(families_[family]);
      QVector<double> below, above;
      std::vector<const ScatterPoint*> own;
      for (const ScatterPoint& one : points_)
        if (one.family == family && one.faint == faint) own.push_back(&one);
      std::sort(own.begin(), own.end(), [](const auto* a, const auto* b) { return a->x < b->x; });
      for (const ScatterPoint* one : own) {
        const QPointF at = shown(*one);
        graph->addData(at.x(), at.y());
        below << 0;
        above << std::max(0.0, one->whisker - at.y());
      }
      auto* bars = new QCPErrorBars(plot_->xAxis, plot_->yAxis);
      bars->removeFromLegend();
      bars->setDataPlottable(graph);
      bars->setSymbolGap(0);
      bars->setWhiskerWidth(5);
      bars->setPen(QPen(color, 1));
      bars->setData(below, above);
      const bool there = std::any_of(points_.begin(), points_.end(),
                                     [&](const ScatterPoint& one) { return one.family == family; });
      if (!faint && there) graph->addToLegend();
    }
  }
}

/// Rings, the frame of the current one, and what came of points.
void ScatterPlot::draw_marks(const QPalette& palette) {
  const QColor ink = palette.color(QPalette::Text);
  QCPGraph* rings =
      add_marks(*plot_, {QCPScatterStyle::ssCircle, QPen(ink, 2), Qt::NoBrush, ring_size});
  QCPGraph* frame =
      add_marks(*plot_, {QCPScatterStyle::ssSquare, QPen(palette.color(QPalette::Highlight), 2),
                         Qt::NoBrush, frame_size});
  QCPGraph* came =
      add_marks(*plot_, {QCPScatterStyle::ssCross, QPen(ink, 1.5), Qt::NoBrush, mark_size});
  came->setName(tr("what came of it"));
  for (int i = 0; i < points_.size(); ++i) {
    const QPointF at = shown(points_[i]);
    if (points_[i].chosen) rings->addData(at.x(), at.y());
    if (i == current_) frame->addData(at.x(), at.y());
    if (!points_[i].came) continue;
    const QPointF there(std::clamp(points_[i].came->x(), x_.from, x_.to),
                        std::clamp(std::max(points_[i].came->y(), floor_), y_.from, y_.to));
    auto* line = new QCPItemLine(plot_);
    line->start->setCoords(at);
    line->end->setCoords(there);
    line->setPen(QPen(ink, 1, Qt::DotLine));
    if (there.x() == points_[i].came->x())
      came->addData(there.x(), there.y());
    else
      draw_beyond(points_[i].came->x(), there, ink);
  }
  if (came->dataCount() > 0) came->addToLegend();
}

/// What came of a point and lies beside the axis, which is the points' own: as a number at its end.
void ScatterPlot::draw_beyond(double x, const QPointF& end, const QColor& ink) {
  const bool right = end.x() == x_.to;
  auto* text = new QCPItemText(plot_);
  text->position->setCoords(end);
  const bool low = pixel(end).y() > plot_->axisRect()->center().y();
  text->setPositionAlignment((right ? Qt::AlignRight : Qt::AlignLeft) |
                             (low ? Qt::AlignBottom : Qt::AlignTop));
  text->setText((right ? QStringLiteral("✕ %1 →") : QStringLiteral("← %1 ✕")).arg(x, 0, 'g', 3));
  text->setColor(ink);
}

void ScatterPlot::draw_level(const QPalette& palette) {
  if (!level_) return;
  const QColor color = palette.color(QPalette::Link);
  auto* line = new QCPItemStraightLine(plot_);
  line->point1->setCoords(x_.from, *level_);
  line->point2->setCoords(x_.to, *level_);
  line->setPen(QPen(color, 2, level_counts_ ? Qt::SolidLine : Qt::DashLine));
  auto* text = new QCPItemText(plot_);
  text->position->setTypeX(QCPItemPosition::ptAxisRectRatio);
  text->position->setCoords(0.995, *level_);
  text->setPositionAlignment(Qt::AlignRight | Qt::AlignBottom);
  text->setText(level_name_);
  text->setColor(color);
}

/// Each beside its point, where it hides no other name and no point, if there is such a place.
void ScatterPlot::place_names() {
  QList<QPointF> points;
  for (const ScatterPoint& one : points_) points << pixel(shown(one));
  NamePlaces places(plot_->axisRect()->rect(), points);
  for (const auto& [point, text] : names_) {
    const QSize size = QFontMetrics(text->font()).size(Qt::TextSingleLine, text->text());
    const QPointF corner = places.place(pixel(shown(points_[point])), size);
    text->position->setType(QCPItemPosition::ptAbsolute);
    text->setPositionAlignment(Qt::AlignLeft | Qt::AlignTop);
    text->position->setCoords(corner);
  }
}

}  // namespace metamer::gui
