#pragma once

#include <QCache>
#include <QSet>
#include <memory>

#include "client/gui/picture/picture_layer.h"
#include "client/gui/picture/tile.h"

namespace metamer::gui {

/// A picture of X Y Z. What is seen of it is developed, in tiles: those of its own pixels at once;
/// those that stand for more on the thread pool, with a coarse picture in their place until then.
class XyzLayer : public PictureLayer {
  Q_OBJECT
 public:
  explicit XyzLayer(ShownXyz shown);

  QSize size() const override { return {shown_.xyz->width, shown_.xyz->height}; }
  void set_viewing(const Viewing& viewing) override;
  void paint(QPainter& painter, const QRectF& target, const QRectF& seen, double ratio) override;
  QImage image() const override;
  std::array<QString, 3> numbers(const QPoint& pixel) const override;  ///< X Y Z
  std::optional<std::size_t> outside() const override { return outside_; }
  QString output() const override;
  void forget() override { tiles_.clear(); }

  /// Bytes of developed tiles are never more than this: what was not painted for longest goes.
  static constexpr qsizetype most_bytes = qsizetype{64} << 20;
  qsizetype bytes() const { return tiles_.totalCost(); }
  int developed() const { return developed_; }  ///< Tiles, since the beginning.
  bool waits() const { return !asked_.isEmpty(); }

 private:
  const QImage* tile(const TilePlace& place);
  void ask(const TilePlace& place);
  void keep(const TilePlace& place, const QImage& image);
  void count();

  ShownXyz shown_;
  Viewing viewing_;
  std::shared_ptr<const TileMaker> maker_;  ///< Of this viewing: what others made is dropped.
  QCache<TilePlace, QImage> tiles_{most_bytes};
  QSet<TilePlace> asked_;
  QImage coarse_;
  std::optional<std::size_t> outside_;
  int developed_ = 0;
};

/// Which level is painted where a pixel of the picture has `scale` pixels of the device, and
/// `seen`, in pixels of the device, is what is seen of it: the last that is not enlarged and of
/// which all that is seen fits into half of what is kept.
int level_of(double scale, const QSizeF& seen);

}  // namespace metamer::gui
