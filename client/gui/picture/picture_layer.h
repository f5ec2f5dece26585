#pragma once

#include <QObject>
#include <QPainter>
#include <QSize>
#include <QString>
#include <array>
#include <optional>

#include "client/gui/picture/viewing.h"

namespace metamer::gui {

/// What a canvas paints: one picture, as it is looked at.
class PictureLayer : public QObject {
  Q_OBJECT
 public:
  /// Of the picture, in its pixels.
  virtual QSize size() const = 0;
  virtual void set_viewing(const Viewing& viewing) = 0;
  /// Paints it all into `target`, of which no more than `seen` is asked for. Both are in the
  /// painter's coordinates; a unit of these has `ratio` pixels of the device.
  virtual void paint(QPainter& painter, const QRectF& target, const QRectF& seen, double ratio) = 0;
  /// The picture's own numbers, at full size: those of `metamer render`'s .png. Made anew where it
  /// is of X Y Z.
  virtual QImage image() const = 0;
  /// The numbers of a pixel, to be written into it.
  virtual std::array<QString, 3> numbers(const QPoint& pixel) const = 0;
  /// How many pixels the output can't show; nothing: it is not asked for, or not known (yet).
  virtual std::optional<std::size_t> outside() const { return std::nullopt; }
  /// What it can't show them in: "sRGB".
  virtual QString output() const { return {}; }

  /// It is not seen for now: what it can make again goes.
  virtual void forget() {}

 Q_SIGNALS:
  /// There is more to paint.
  void changed();
};

}  // namespace metamer::gui
