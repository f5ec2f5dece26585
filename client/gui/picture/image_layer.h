#pragma once

#include <QColorTransform>
#include <QImage>

#include "client/gui/picture/picture_layer.h"

namespace metamer::gui {

/// A picture of 8-bit numbers: a frame, a map, a job's picture that grows. What it clipped is gone:
/// of exposure it shows what is left, and of gamut nothing.
class ImageLayer : public PictureLayer {
  Q_OBJECT
 public:
  /// `image`, RGB32, stands for a picture of `size`, which may be larger.
  ImageLayer(QImage image, const QSize& size, QColorSpace space);

  /// A part of the image anew, if it lies inside it.
  void set_part(const QPoint& corner, const QImage& part);

  QSize size() const override { return size_; }
  void set_viewing(const Viewing& viewing) override;
  void paint(QPainter& painter, const QRectF& target, const QRectF& seen, double ratio) override;
  QImage image() const override { return image_; }
  std::array<QString, 3> numbers(const QPoint& pixel) const override;

 private:
  /// As it is looked at; shares the image where that is the same.
  QImage viewed(const QImage& image) const;

  QImage image_, viewed_;
  QSize size_;
  QColorSpace space_;
  Viewing viewing_;
  std::array<std::uint8_t, 256> exposed_{};  ///< Codes under the exposure.
  QColorTransform transform_;
};

}  // namespace metamer::gui
