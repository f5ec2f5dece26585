#pragma once

#include <QList>
#include <QPointF>
#include <QRectF>
#include <QSize>

namespace metamer::gui {

/// Where names stand beside points: one after the other each takes the first of eight places near
/// its point, then of eight a little farther, where it lies within the area and hides neither a
/// name nor a point; the first of all where there is none. Pixels.
class NamePlaces {
 public:
  NamePlaces(const QRectF& area, const QList<QPointF>& points);
  /// The upper left corner of a name of that size.
  QPointF place(const QPointF& point, const QSizeF& size);

 private:
  bool is_free(const QRectF& name) const;

  QRectF area_;
  QList<QRectF> taken_;
};

}  // namespace metamer::gui
