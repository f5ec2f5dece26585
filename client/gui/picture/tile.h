#pragma once

#include <QColorTransform>
#include <QImage>
#include <cmath>

#include "client/gui/picture/shown_xyz.h"
#include "client/gui/picture/viewing.h"
#include "client/tools/pictures/screen_pixels.h"

namespace metamer::gui {

inline constexpr int tile_side = 256;  ///< Pixels.

/// A part of a picture: of level 0 its pixels, of level n means of squares of 2^n pixels.
struct TilePlace {
  int level = 0, x = 0, y = 0;  ///< Tiles from the upper left.
  bool operator==(const TilePlace&) const = default;
  /// The picture's pixels that it shows, where the picture is that large.
  QRect area(const QSize& picture) const {
    const int side = tile_side << level;
    return QRect(x * side, y * side, side, side).intersected(QRect(QPoint(), picture));
  }
};
inline size_t qHash(const TilePlace& place, size_t seed = 0) {
  return qHashMulti(seed, place.level, place.x, place.y);
}

/// What makes screens' pixels of X Y Z. From any thread.
class TileMaker {
 public:
  TileMaker(const ShownXyz& shown, const Viewing& viewing);

  /// RGB32, at most tile_side square.
  QImage make(const TilePlace& place) const;
  /// The whole picture by one pixel of each square of `side`: at once.
  QImage sample(int side) const;
  /// Pixels of the whole picture that the output can't show.
  std::size_t count_outside() const;

 private:
  QImage develop(const Image& xyz, const QRect& area) const;
  void mark(const QRect& area, int side, QImage& tile) const;

  ShownXyz shown_;
  client::ScreenPixels pixels_;
  double exposure_;
  bool gamut_;
  QColorTransform transform_;
};

/// The picture's own numbers, as a whole: those of `metamer render`'s .png. RGB32.
QImage whole_image(const ShownXyz& shown);

}  // namespace metamer::gui
