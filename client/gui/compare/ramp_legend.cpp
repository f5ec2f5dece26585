#include "client/gui/compare/ramp_legend.h"

#include <QPainter>
#include <cmath>

#include "common/image/ramp.h"
#include "common/problem.h"

namespace metamer::gui {
namespace {

constexpr int bar = 12, margin = 12;

}  // namespace

RampLegend::RampLegend(QWidget* parent) : QWidget(parent) {
  setAccessibleName(tr("Scale of the map"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void RampLegend::set_scale(double top, const QString& unit) {
  top_ = top;
  unit_ = unit;
  setAccessibleDescription(tr("%1 from black at 0 to white at %2").arg(unit).arg(top));
  update();
}

QSize RampLegend::sizeHint() const { return {320, bar + fontMetrics().height() + 8}; }

void RampLegend::paintEvent(QPaintEvent*) {
  if (!(top_ > 0)) return;
  QPainter painter(this);
  const QRect colors(margin, 2, width() - 2 * margin, bar);
  for (int x = 0; x < colors.width(); ++x) {
    const Rgb color = cubehelix(static_cast<double>(x) / std::max(1, colors.width() - 1));
    painter.fillRect(colors.left() + x, colors.top(), 1, bar,
                     QColor::fromRgbF(static_cast<float>(color[0]), static_cast<float>(color[1]),
                                      static_cast<float>(color[2])));
  }
  painter.setPen(palette().color(QPalette::WindowText));
  painter.drawRect(colors.adjusted(-1, -1, 0, 0));
  const QRect numbers(margin, 2 + bar + 2, colors.width(), fontMetrics().height());
  const auto text = [](double value) { return QString::fromStdString(number_text(value)); };
  painter.drawText(numbers, Qt::AlignLeft, QStringLiteral("0"));
  painter.drawText(numbers, Qt::AlignHCenter, QStringLiteral("%1 %2").arg(text(top_ / 2), unit_));
  painter.drawText(numbers, Qt::AlignRight, text(top_));
}

}  // namespace metamer::gui
