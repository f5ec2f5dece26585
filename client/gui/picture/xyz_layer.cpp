#include "client/gui/picture/xyz_layer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "client/gui/app/on_pool.h"

namespace metamer::gui {
namespace {

constexpr int coarse_side = 512;             // pixels of the picture that stands in
constexpr int most_asked = 8;                // tiles at a time: what is seen may change
constexpr qint64 small_picture = 4'000'000;  // pixels: as many are averaged at once

}  // namespace

int level_of(double scale, const QSizeF& seen) {
  int level = scale >= 1 ? 0 : static_cast<int>(std::floor(std::log2(1 / scale)));
  const double pixels = seen.width() * seen.height() / (scale * scale);
  while (4 * std::ldexp(pixels, -2 * level) > XyzLayer::most_bytes / 2.0) ++level;
  return level;
}

XyzLayer::XyzLayer(ShownXyz shown) : shown_(std::move(shown)) { set_viewing({}); }

void XyzLayer::set_viewing(const Viewing& viewing) {
  if (maker_ != nullptr && viewing == viewing_) return;
  viewing_ = viewing;
  maker_ = std::make_shared<const TileMaker>(shown_, viewing_);
  tiles_.clear();
  asked_.clear();
  coarse_ = {};
  outside_.reset();
  if (viewing_.gamut) count();
}

void XyzLayer::count() {
  on_pool(
      this, [maker = maker_] { return maker->count_outside(); },
      [this, maker = maker_](std::size_t outside) {
        if (maker != maker_) return;
        outside_ = outside;
        Q_EMIT changed();
      });
}

void XyzLayer::keep(const TilePlace& place, const QImage& image) {
  ++developed_;
  tiles_.insert(place, new QImage(image), image.sizeInBytes());
}

void XyzLayer::ask(const TilePlace& place) {
  if (asked_.size() >= most_asked || asked_.contains(place)) return;
  asked_.insert(place);
  on_pool(
      this, [maker = maker_, place] { return maker->make(place); },
      [this, maker = maker_, place](const QImage& image) {
        if (maker != maker_) return;
        asked_.remove(place);
        keep(place, image);
        Q_EMIT changed();
      });
}

/// Null: it is being made.
const QImage* XyzLayer::tile(const TilePlace& place) {
  if (const QImage* there = tiles_.object(place)) return there;
  if (place.level > 0 && qint64{size().width()} * size().height() > small_picture) {
    ask(place);
    return nullptr;
  }
  keep(place, maker_->make(place));
  return tiles_.object(place);
}

void XyzLayer::paint(QPainter& painter, const QRectF& target, const QRectF& seen, double ratio) {
  const double scale = target.width() / size().width();
  painter.setRenderHint(QPainter::SmoothPixmapTransform, scale * ratio < 1);
  const QRectF inside = seen.intersected(target).translated(-target.topLeft());
  if (inside.isEmpty()) return;
  const int level = level_of(scale * ratio, inside.size() * ratio), side = tile_side << level;
  const auto first = [&](double edge) { return static_cast<int>(edge / scale) / side; };
  // Edges fall on pixels of the device, that no gap is between tiles.
  const auto on_device = [&](double place) { return std::round(place * ratio) / ratio; };
  const auto place_of = [&](const QRect& area) {
    return QRectF(
        QPointF(on_device(target.x() + area.x() * scale), on_device(target.y() + area.y() * scale)),
        QPointF(on_device(target.x() + (area.x() + area.width()) * scale),
                on_device(target.y() + (area.y() + area.height()) * scale)));
  };
  for (int y = first(inside.top()); y * side < inside.bottom() / scale; ++y)
    for (int x = first(inside.left()); x * side < inside.right() / scale; ++x) {
      const TilePlace place{level, x, y};
      const QRect area = place.area(size());
      if (area.isEmpty()) continue;
      if (const QImage* image = tile(place)) {
        painter.drawImage(place_of(area), *image);
        continue;
      }
      const int step = std::max(1, std::max(size().width(), size().height()) / coarse_side);
      if (coarse_.isNull()) coarse_ = maker_->sample(step);
      painter.drawImage(place_of(area), coarse_,
                        QRectF(QPointF(area.topLeft()) / step, QSizeF(area.size()) / step));
    }
}

QImage XyzLayer::image() const { return whole_image(shown_); }

std::array<QString, 3> XyzLayer::numbers(const QPoint& pixel) const {
  const float* xyz = shown_.xyz->at(pixel.x(), pixel.y());
  std::array<QString, 3> texts;
  for (std::size_t c = 0; c < texts.size(); ++c)
    texts[c] = QString::number(static_cast<double>(xyz[c]), 'g', 3);
  return texts;
}

QString XyzLayer::output() const { return QString::fromStdString(shown_.developing.space.name); }

}  // namespace metamer::gui
