// A picture of 8 bits under an exposure and on another display, against the same of X Y Z.
#include "client/gui/picture/image_layer.h"

#include <gtest/gtest.h>

#include "client/gui/picture/tile.h"

namespace metamer::gui {
namespace {

/// Greys from black to white, a pixel a code.
std::shared_ptr<const Image> greys() {
  auto image = std::make_shared<Image>(make_image(256, 1, {"X", "Y", "Z"}));
  const RgbSpace& srgb = rgb_space(StandardSpace::srgb);
  for (int x = 0; x < 256; ++x) {
    const double light = decode(srgb.transfer, x / 255.0);
    const Vector3 xyz = multiply(srgb.to_xyz, Vector3{light, light, light});
    for (std::size_t c = 0; c < 3; ++c) image->at(x, 0)[c] = static_cast<float>(xyz[c]);
  }
  return image;
}

QImage image_painted(PictureLayer& layer) {
  QImage screen(layer.size(), QImage::Format_RGB32);
  QPainter painter(&screen);
  layer.paint(painter, screen.rect(), screen.rect(), 1);
  return screen;
}

TEST(ImageLayer, UnderAnExposureItIsAsTheSamePictureOfXyz) {
  const ShownXyz shown{greys()};
  for (const double stops : {-2.0, -1.0 / 3, 0.5, 1.0}) {
    const Viewing viewing{.stops = stops};
    ImageLayer layer(whole_image(shown), {256, 1}, QColorSpace::SRgb);
    layer.set_viewing(viewing);
    const QImage eight = image_painted(layer), exact = TileMaker(shown, viewing).sample(1);
    for (int x = 0; x < 256; ++x)
      EXPECT_NEAR(qGreen(eight.pixel(x, 0)), qGreen(exact.pixel(x, 0)), 1) << x << " " << stops;
  }
}

TEST(ImageLayer, APartIsPutIntoThePictureAndIntoWhatIsSeenOfIt) {
  QImage image(16, 16, QImage::Format_RGB32);
  image.fill(QColor(10, 10, 10));
  QImage part(4, 4, QImage::Format_RGB32);
  part.fill(QColor(100, 0, 0));
  ImageLayer layer(image, {64, 64}, QColorSpace::SRgb);
  layer.set_part({2, 3}, part);
  EXPECT_EQ(layer.image().pixelColor(3, 4), QColor(100, 0, 0));
  EXPECT_EQ(layer.numbers({4 * 3, 4 * 4})[0], QStringLiteral("100"));
  layer.set_viewing({.stops = 1});
  layer.set_part({8, 8}, part);
  layer.set_part({14, 14}, part);  // lies outside in part
  EXPECT_EQ(layer.image().pixelColor(9, 9), QColor(100, 0, 0));
  const QImage seen = image_painted(layer);
  EXPECT_EQ(seen.size(), QSize(64, 64));
  EXPECT_EQ(seen.pixel(4 * 3, 4 * 4), seen.pixel(4 * 9, 4 * 9));
  EXPECT_GT(qRed(seen.pixel(4 * 9, 4 * 9)), 120);
  EXPECT_EQ(layer.image().pixelColor(15, 15), QColor(10, 10, 10));
}

}  // namespace
}  // namespace metamer::gui
