#include "client/gui/plot/scatter_names.h"

#include <algorithm>

namespace metamer::gui {
namespace {

constexpr double mark = 5;          // half a point's size
constexpr double gaps[] = {9, 24};  // between a point and its name: a ring has room there

}  // namespace

NamePlaces::NamePlaces(const QRectF& area, const QList<QPointF>& points) : area_(area) {
  for (const QPointF& point : points)
    taken_ << QRectF(point.x() - mark, point.y() - mark, 2 * mark, 2 * mark);
}

bool NamePlaces::is_free(const QRectF& name) const {
  return area_.contains(name) && std::none_of(taken_.begin(), taken_.end(), [&](const QRectF& one) {
           return one.intersects(name);
         });
}

QPointF NamePlaces::place(const QPointF& point, const QSizeF& size) {
  QList<QPointF> corners;
  for (const double gap : gaps) {
    const double right = point.x() + gap, left = point.x() - gap - size.width();
    const double middle = point.x() - size.width() / 2, level = point.y() - size.height() / 2;
    const double above = point.y() - gap - size.height(), below = point.y() + gap;
    corners << QPointF(right, above) << QPointF(right, level) << QPointF(right, below)
            << QPointF(middle, above) << QPointF(left, below) << QPointF(middle, below)
            << QPointF(left, level) << QPointF(left, above);
  }
  const auto free = std::find_if(corners.begin(), corners.end(),
                                 [&](const QPointF& at) { return is_free(QRectF(at, size)); });
  const QPointF corner = free != corners.end() ? *free : corners[0];
  taken_ << QRectF(corner, size);
  return corner;
}

}  // namespace metamer::gui
