#include "client/gui/picture/image_layer.h"

#include <cmath>
#include <utility>

namespace metamer::gui {
namespace {

/// What codes of a space become where there is 2^stops as much light.
std::array<std::uint8_t, 256> exposed_codes(const QColorSpace& space, double stops) {
  const QColorSpace linear = space.withTransferFunction(QColorSpace::TransferFunction::Linear);
  const QColorTransform decode = space.transformationToColorSpace(linear),
                        encode = linear.transformationToColorSpace(space);
  std::array<std::uint8_t, 256> codes{};
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const auto code = static_cast<quint16>(257 * i);
    const QRgba64 light = decode.map(qRgba64(code, code, code, 0xffff));
    const auto more = static_cast<quint16>(std::min(65535.0, light.green() * std::exp2(stops)));
    codes[i] = encode.map(qRgba64(more, more, more, 0xffff)).green8();
  }
  return codes;
}

}  // namespace

ImageLayer::ImageLayer(QImage image, const QSize& size, QColorSpace space)
    : image_(std::move(image)), size_(size), space_(std::move(space)) {
  set_viewing({});
}

void ImageLayer::set_viewing(const Viewing& viewing) {
  viewing_ = viewing;
  transform_ = {};
  if (space_ != viewing_.display) transform_ = space_.transformationToColorSpace(viewing_.display);
  if (viewing_.stops != 0) exposed_ = exposed_codes(space_, viewing_.stops);
  viewed_ = viewed(image_);
}

QImage ImageLayer::viewed(const QImage& image) const {
  QImage result = image;
  if (viewing_.stops != 0)
    for (int y = 0; y < result.height(); ++y) {
      auto* const row = reinterpret_cast<QRgb*>(result.scanLine(y));
      for (int x = 0; x < result.width(); ++x) {
        const auto code = [&](int value) { return exposed_[static_cast<std::size_t>(value)]; };
        row[x] = qRgb(code(qRed(row[x])), code(qGreen(row[x])), code(qBlue(row[x])));
      }
    }
  if (!transform_.isIdentity()) result.applyColorTransform(transform_);
  return result;
}

void ImageLayer::set_part(const QPoint& corner, const QImage& part) {
  if (!image_.rect().contains(QRect(corner, part.size()))) return;
  const bool shared = viewed_.cacheKey() == image_.cacheKey();
  viewed_ = shared ? QImage() : viewed_;
  const auto put = [&](QImage& into, const QImage& what) {
    QPainter painter(&into);
    painter.setCompositionMode(QPainter::CompositionMode_Source);
    painter.drawImage(corner, what);
  };
  put(image_, part);
  if (shared)
    viewed_ = image_;
  else
    put(viewed_, viewed(part));
}

void ImageLayer::paint(QPainter& painter, const QRectF& target, const QRectF&, double ratio) {
  // Reduced pictures are averaged; enlarged ones show their pixels.
  painter.setRenderHint(QPainter::SmoothPixmapTransform, target.width() * ratio < viewed_.width());
  painter.drawImage(target, viewed_);
}

std::array<QString, 3> ImageLayer::numbers(const QPoint& pixel) const {
  const QPoint at(pixel.x() * image_.width() / size_.width(),
                  pixel.y() * image_.height() / size_.height());
  const QColor color = image_.pixelColor(at);
  return {QString::number(color.red()), QString::number(color.green()),
          QString::number(color.blue())};
}

}  // namespace metamer::gui
