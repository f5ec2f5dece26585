// What stands over a picture: text, marks, axes, the count of what is lost, numbers.
#include <QPainter>
#include <algorithm>
#include <array>
#include <utility>

#include "client/gui/picture/canvas.h"

namespace metamer::gui {

void Canvas::paint_overlay(QPainter& painter) const {
  QStringList lines = overlay_;
  if (!stale_.isEmpty()) lines << stale_;
  if (lines.isEmpty()) return;
  const QFontMetrics metrics(font());
  int wide = 0;
  for (const QString& line : lines) wide = std::max(wide, metrics.horizontalAdvance(line));
  const QRect box(8, 8, wide + 16, static_cast<int>(lines.size()) * metrics.lineSpacing() + 10);
  painter.fillRect(box, QColor(0, 0, 0, 150));
  painter.setPen(Qt::white);
  painter.drawText(box.adjusted(8, 5, 0, 0), Qt::AlignLeft | Qt::AlignTop,
                   lines.join(QLatin1Char('\n')));
}

void Canvas::paint_marks(QPainter& painter) const {
  constexpr double arm = 6;
  for (const CanvasMark& mark : marks_) {
    const QRectF picture = target();
    const QPointF at = picture.topLeft() +
                       QPointF(mark.place.x() * picture.width(), mark.place.y() * picture.height());
    // Seen on any colour.
    for (const auto& [color, width] :
         {std::pair{QColor(Qt::black), 3.0}, {QColor(Qt::white), 1.0}}) {
      painter.setPen(QPen(color, width));
      painter.drawLine(at - QPointF(arm, 0), at + QPointF(arm, 0));
      painter.drawLine(at - QPointF(0, arm), at + QPointF(0, arm));
    }
    const QRectF box(at + QPointF(arm, -arm - 14), QSizeF(22, 16));
    painter.fillRect(box, QColor(0, 0, 0, 150));
    painter.drawText(box, Qt::AlignCenter, mark.text);
  }
}

void Canvas::paint_axes(QPainter& painter) const {
  if (!axes_) return;
  constexpr double length = 28;
  const QPointF origin(44, height() - 44);
  const std::array<const char*, 3> names{"x", "y", "z"};
  painter.setRenderHint(QPainter::Antialiasing);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const QPointF tip = origin + (*axes_)[i] * length;
    for (const auto& [color, width] :
         {std::pair{QColor(0, 0, 0, 160), 4.0}, {QColor(Qt::white), 1.6}}) {
      painter.setPen(QPen(color, width));
      painter.drawLine(origin, tip);
    }
    painter.setPen(Qt::white);
    painter.drawText(QRectF(origin + (*axes_)[i] * (length + 10) - QPointF(8, 8), QSizeF(16, 16)),
                     Qt::AlignCenter, QString::fromLatin1(names[i]));
  }
}

/// In the lower right corner: what the output can't show.
void Canvas::paint_outside(QPainter& painter) const {
  const std::optional<std::size_t> outside = layer_->outside();
  if (!outside) return;
  const QString text = tr("%L1 outside %2").arg(*outside).arg(layer_->output());
  const QFontMetrics metrics(font());
  const int high = metrics.lineSpacing();
  const QSize box(metrics.horizontalAdvance(text) + high + 20, high + 10);
  const QRect place(QPoint(width() - box.width() - 8, height() - box.height() - 8), box);
  painter.fillRect(place, QColor(0, 0, 0, 180));
  painter.fillRect(QRect(place.topLeft() + QPoint(8, 8), QSize(high - 6, high - 6)), gamut_mark);
  painter.setPen(Qt::white);
  painter.drawText(place.adjusted(0, 0, -8, 0), Qt::AlignRight | Qt::AlignVCenter, text);
}

/// With the grid of the pixels, on which the numbers stand.
void Canvas::paint_numbers(QPainter& painter) const {
  const QRectF inside((QPointF() - target().topLeft()) / scale(), QSizeF(size()) / scale());
  const QRect seen = inside.toAlignedRect().intersected(QRect(QPoint(), picture_size()));
  QFont small = font();
  small.setPixelSize(std::max(7, static_cast<int>(scale() / 5)));
  painter.setFont(small);
  const QPen grid(QColor(119, 119, 119), 0);
  for (int y = seen.top(); y <= seen.bottom(); ++y)
    for (int x = seen.left(); x <= seen.right(); ++x) {
      const QRectF pixel(place_of({x, y}), QSizeF(scale(), scale()));
      painter.setPen(grid);
      painter.drawRect(pixel);
      // Read on any colour.
      const std::array<QString, 3> numbers = layer_->numbers({x, y});
      const QString text = numbers[0] + u'\n' + numbers[1] + u'\n' + numbers[2];
      painter.setPen(Qt::black);
      painter.drawText(pixel.translated(1, 1), Qt::AlignCenter, text);
      painter.setPen(Qt::white);
      painter.drawText(pixel, Qt::AlignCenter, text);
    }
  painter.setFont(font());
}

}  // namespace metamer::gui
