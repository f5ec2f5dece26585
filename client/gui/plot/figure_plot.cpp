#include "client/gui/plot/figure_plot.h"

#include <qcustomplot.h>

#include <QFileDialog>
#include <QMenu>
#include <QMessageBox>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "client/gui/plot/plot_style.h"

namespace metamer::gui {
namespace {

// Of a round panel, in units of its scale: what is seen to the sides of the circle and above it,
// and below the surface.
constexpr double beside = 1.14, above = 1.16, below = -0.1;

QPointF on_circle(double degrees, double radius) {
  return {radius * std::sin(client::radians(degrees)), radius * std::cos(client::radians(degrees))};
}

QPen pen_of_curve(int i, const QPalette& palette) {
  return QPen(curve_color(i, palette), 1.6, i < curve_colors ? Qt::SolidLine : Qt::DashLine);
}

/// A line of the grid.
void add_line(QCPAxisRect& rect, const std::vector<QPointF>& points, const QPen& pen) {
  auto* curve = new QCPCurve(rect.axis(QCPAxis::atBottom), rect.axis(QCPAxis::atLeft));
  for (const QPointF& point : points) curve->addData(point.x(), point.y());
  curve->setPen(pen);
}

void add_label(QCPAxisRect& rect, const QPointF& place, const QString& words, const QColor& color,
               Qt::Alignment alignment) {
  auto* text = new QCPItemText(rect.parentPlot());
  text->setClipAxisRect(&rect);
  text->position->setAxes(rect.axis(QCPAxis::atBottom), rect.axis(QCPAxis::atLeft));
  text->position->setCoords(place);
  text->setPositionAlignment(alignment);
  text->setText(words);
  text->setColor(color);
}

/// Half circles at the steps of the scale, and rays every 30°.
void draw_round_grid(QCPAxisRect& rect, const client::Scale& scale, const QPalette& palette) {
  const QColor ink = palette.color(QPalette::Text);
  QColor faint = ink;
  faint.setAlpha(50);
  const int steps = static_cast<int>(std::round(scale.top / scale.step));
  for (int i = 1; i <= steps; ++i) {
    const double radius = i * scale.step;
    std::vector<QPointF> circle;
    for (int degrees = -90; degrees <= 90; degrees += 3)
      circle.push_back(on_circle(degrees, radius));
    add_line(rect, circle, QPen(faint));
    add_label(rect, {radius, 0}, QString::number(radius, 'g', 3), ink,
              Qt::AlignHCenter | Qt::AlignTop);
  }
  for (int degrees = -90; degrees <= 90; degrees += 30) {
    add_line(rect, {{0, 0}, on_circle(degrees, scale.top)}, QPen(faint));
    if (std::abs(degrees) == 90) continue;
    add_label(rect, on_circle(degrees, 1.07 * scale.top), QStringLiteral("%1°").arg(degrees), ink,
              Qt::AlignCenter);
  }
}

void draw_round(QCPAxisRect& rect, const client::Panel& panel, const client::Scale& scale,
                QCPLegend& legend, const QPalette& palette) {
  for (QCPAxis* axis : rect.axes()) axis->setVisible(false);
  for (QCPAxis* axis : rect.axes()) axis->grid()->setVisible(false);
  draw_round_grid(rect, scale, palette);
  for (std::size_t c = 0; c < panel.curves.size(); ++c) {
    const client::Curve& one = panel.curves[c];
    const QPen pen = pen_of_curve(static_cast<int>(c), palette);
    auto* curve = new QCPCurve(rect.axis(QCPAxis::atBottom), rect.axis(QCPAxis::atLeft));
    curve->setPen(pen);
    curve->setName(QString::fromStdString(one.label));
    for (std::size_t i = 0; i < one.angle.size(); ++i) {
      const QPointF point = on_circle(one.angle[i], one.value[i]);
      curve->addData(point.x(), point.y());
    }
    curve->addToLegend(&legend);
    if (one.incidence)
      add_line(rect, {on_circle(-*one.incidence, scale.top), {0, 0}},
               QPen(pen.color(), 1, Qt::DotLine));
  }
}

void draw_straight(QCPAxisRect& rect, const client::Panel& panel, const client::Scale& scale,
                   QCPLegend& legend, const QPalette& palette) {
  QCPAxis *angle = rect.axis(QCPAxis::atBottom), *value = rect.axis(QCPAxis::atLeft);
  angle->setLabel(QString::fromStdString(panel.angle) + FigurePlot::tr(" / degrees"));
  value->setLabel(QString::fromStdString(panel.value));
  double from = 0, to = 1;
  for (std::size_t c = 0; c < panel.curves.size(); ++c) {
    const client::Curve& one = panel.curves[c];
    QCPGraph* graph = rect.parentPlot()->addGraph(angle, value);
    graph->setPen(pen_of_curve(static_cast<int>(c), palette));
    graph->setName(QString::fromStdString(one.label));
    graph->setData(QVector<double>(one.angle.begin(), one.angle.end()),
                   QVector<double>(one.value.begin(), one.value.end()), true);
    graph->addToLegend(&legend);
    from = c == 0 ? one.angle.front() : std::min(from, one.angle.front());
    to = c == 0 ? one.angle.back() : std::max(to, one.angle.back());
  }
  angle->setRange(from, to);
  value->setRange(0, scale.top);
}

}  // namespace

FigurePlot::FigurePlot(QWidget* parent) : QWidget(parent), plot_(new QCustomPlot(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(plot_);
  setMinimumSize(280, 220);
  setAccessibleName(tr("Diagram"));
  plot_->setAutoAddPlottableToLegend(false);
  connect(plot_, &QCustomPlot::afterLayout, this, &FigurePlot::keep_round);
  draw(palette());
}

void FigurePlot::set_figure(const client::Figure& figure) {
  figure_ = figure;
  setAccessibleDescription(QString::fromStdString(figure_.title));
  draw(palette());
}

void FigurePlot::draw(const QPalette& palette) {
  plot_->clearPlottables();
  plot_->clearItems();
  plot_->plotLayout()->clear();
  round_.clear();
  const int columns = std::max(1, figure_.columns);
  for (std::size_t i = 0; i < figure_.panels.size(); ++i) {
    const int at = static_cast<int>(i);
    draw_panel(figure_.panels[i], at / columns, at % columns, palette);
  }
  apply_theme(*plot_, palette);
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

/// A panel takes three rows of the grid: title, diagram, legend.
void FigurePlot::draw_panel(const client::Panel& panel, int row, int column,
                            const QPalette& palette) {
  auto* title = new QCPTextElement(plot_, QString::fromStdString(panel.title));
  title->setTextColor(palette.color(QPalette::Text));
  auto* rect = new QCPAxisRect(plot_);
  auto* legend = new QCPLegend;
  QCPLayoutGrid& grid = *plot_->plotLayout();
  grid.addElement(3 * row, column, title);
  grid.addElement(3 * row + 1, column, rect);
  grid.addElement(3 * row + 2, column, legend);
  grid.setRowStretchFactor(3 * row, 0.001);
  grid.setRowStretchFactor(3 * row + 2, 0.001);
  legend->setLayer(QStringLiteral("legend"));
  legend->setFillOrder(QCPLegend::foColumnsFirst);
  legend->setWrap(figure_.columns > 1 ? 3 : 5);
  legend->setBorderPen(Qt::NoPen);
  legend->setBrush(Qt::NoBrush);
  legend->setTextColor(palette.color(QPalette::Text));

  const client::Scale scale = client::scale_of(figure_, panel.polar);
  if (panel.polar) {
    round_.push_back({rect, scale.top});
    draw_round(*rect, panel, scale, *legend, palette);
  } else {
    draw_straight(*rect, panel, scale, *legend, palette);
  }
}

/// All of the half circle is seen, whatever the shape of the panel.
void FigurePlot::keep_round() {
  for (const RoundPanel& panel : round_) {
    const double wide = std::max(1, panel.rect->width()), high = std::max(1, panel.rect->height());
    const double unit = std::max(2 * beside / wide, (above - below) / high) * panel.top;
    const double middle = panel.top * (above + below) / 2;
    panel.rect->axis(QCPAxis::atBottom)->setRange(-unit * wide / 2, unit * wide / 2);
    panel.rect->axis(QCPAxis::atLeft)->setRange(middle - unit * high / 2, middle + unit * high / 2);
  }
}

Result<void> FigurePlot::save(const QString& file) {
  if (file.endsWith(QStringLiteral(".csv"), Qt::CaseInsensitive))
    return save_text(file, QString::fromStdString(client::csv_text(figure_)));
  draw(paper_palette());
  const Result<void> saved = save_plot(*plot_, size(), file);
  draw(palette());
  return saved;
}

void FigurePlot::save_as() {
  const QString file = QFileDialog::getSaveFileName(
      this, tr("Save the diagram"), QString::fromStdString(figure_.name),
      tr("PDF (*.pdf);;PNG (*.png);;Numbers (*.csv)"));
  if (file.isEmpty()) return;
  if (const Result<void> saved = save(file); !saved)
    QMessageBox::warning(this, tr("Save the diagram"),
                         QString::fromStdString(saved.error().message));
}

void FigurePlot::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) draw(palette());
  QWidget::changeEvent(event);
}

void FigurePlot::contextMenuEvent(QContextMenuEvent* event) {
  QMenu menu(this);
  menu.addAction(tr("&Save…"), this, &FigurePlot::save_as);
  menu.exec(event->globalPos());
}

}  // namespace metamer::gui
