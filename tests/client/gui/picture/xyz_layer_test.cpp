// A picture of X Y Z is developed as far as it is seen.
#include "client/gui/picture/xyz_layer.h"

#include <gtest/gtest.h>

#include <QTest>
#include <cmath>
#include <limits>

#include "client/gui/picture/canvas.h"

namespace metamer::gui {
namespace {

std::shared_ptr<const Image> ramp_picture(int width, int height) {
  auto image = std::make_shared<Image>(make_image(width, height, {"X", "Y", "Z"}));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        image->at(x, y)[c] = static_cast<float>((x * 7 + y * 13 + c * 29) % 257) / 300.0F;
  return image;
}

std::shared_ptr<const Image> flat_picture(int side, float y) {
  auto image = std::make_shared<Image>(make_image(side, side, {"X", "Y", "Z"}));
  // The white of D65, IEC 61966-2-1.
  for (std::size_t i = 0; i < image->pixels.size(); i += 3) {
    image->pixels[i] = 0.9505F * y;
    image->pixels[i + 1] = y;
    image->pixels[i + 2] = 1.089F * y;
  }
  return image;
}

/// What a device of this size shows.
QImage layer_painted(PictureLayer& layer, const QSize& device, const QRectF& target) {
  QImage screen(device, QImage::Format_RGB32);
  screen.fill(Qt::black);
  QPainter painter(&screen);
  layer.paint(painter, target, screen.rect(), 1);
  return screen;
}

TEST(XyzLayer, AtOneToOneTheScreenHasThePicturesNumbersBesideTilesEdgesToo) {
  XyzLayer layer({ramp_picture(700, 520)});
  const QImage own = layer.image();
  for (const QPoint& corner : {QPoint(0, 0), QPoint(-130, -77), QPoint(-690, -510), QPoint(33, 5)})
    EXPECT_EQ(layer_painted(layer, {300, 200}, {corner, layer.size()})
                  .copy(QRect(QPoint(), QSize(300, 200)).intersected(QRect(corner, layer.size()))),
              own.copy(QRect(-corner, QSize(300, 200)).intersected(own.rect())));
}

TEST(XyzLayer, APictureOf8192SquareKeepsNoMoreThan64MiBOfTiles) {
  constexpr int side = 8192;
  XyzLayer layer({flat_picture(side, 0.2F)});
  const QSize screen(1280, 800);
  EXPECT_EQ(layer.bytes(), 0);
  layer_painted(layer, screen, QRectF(0, 0, side, side));
  EXPECT_EQ(layer.developed(), 5 * 4) << "those that are seen";
  layer_painted(layer, screen, QRectF(0, 0, side, side));
  EXPECT_EQ(layer.developed(), 5 * 4) << "kept";

  int most = 0;
  for (int y = 0; y < side; y += 800)
    for (int x = 0; x < side; x += 1280) {
      layer_painted(layer, screen, QRectF(-x, -y, side, side));
      ASSERT_LE(layer.bytes(), XyzLayer::most_bytes);
      most = std::max(most, static_cast<int>(layer.bytes()));
    }
  EXPECT_GE(layer.developed(), 32 * 32);
  EXPECT_GT(most, XyzLayer::most_bytes / 2) << "it is a cache";
  layer.forget();
  EXPECT_EQ(layer.bytes(), 0);
}

TEST(XyzLayer, OfAWholePictureThatIsFarLargerThanTheScreenNoMoreIsDevelopedThanItShows) {
  constexpr int side = 4096;
  XyzLayer layer({flat_picture(side, 0.2F)});
  const QSize screen(500, 500);
  const QRectF target(0, 0, 500, 500);
  const QRgb expected = layer.image().pixel(0, 0);
  EXPECT_EQ(layer_painted(layer, screen, target).pixel(250, 250), expected) << "coarse, at once";
  ASSERT_TRUE(QTest::qWaitFor([&] {
    if (!layer.waits()) layer_painted(layer, screen, target);
    return !layer.waits();
  }));
  EXPECT_EQ(layer_painted(layer, screen, target).pixel(499, 0), expected);
  EXPECT_LE(layer.bytes(), qsizetype{4} * 4 * screen.width() * screen.height());
}

TEST(XyzLayer, ReducedPicturesAreMeansOfLight) {
  auto image = std::make_shared<Image>(*flat_picture(512, 0));
  const auto light = flat_picture(512, 0.4F);
  for (int y = 0; y < 512; ++y)
    for (int x = y % 2; x < 512; x += 2) std::copy_n(light->at(x, y), 3, image->at(x, y));
  XyzLayer chequer({image}), half({flat_picture(256, 0.2F)});
  EXPECT_EQ(layer_painted(chequer, {256, 256}, {0, 0, 256, 256}), half.image());
}

TEST(XyzLayer, AStopIsTwiceTheLight) {
  XyzLayer dim({flat_picture(64, 0.1F)}), bright({flat_picture(64, 0.2F)});
  dim.set_viewing({.stops = 1});
  EXPECT_EQ(layer_painted(dim, {64, 64}, {0, 0, 64, 64}), bright.image());
  EXPECT_NE(dim.image(), bright.image()) << "the picture itself stays";
}

TEST(XyzLayer, MarksAndCountsWhatTheOutputCanNotShow) {
  auto image = std::make_shared<Image>(*flat_picture(600, 0.5F));
  image->at(10, 10)[1] = -1;
  image->at(599, 599)[0] = std::numeric_limits<float>::quiet_NaN();
  image->at(300, 0)[1] = 7;
  XyzLayer layer({image});
  EXPECT_FALSE(layer.outside());
  layer.set_viewing({.gamut = true});
  ASSERT_TRUE(QTest::qWaitFor([&] { return layer.outside().has_value(); }));
  EXPECT_EQ(*layer.outside(), 3U);
  EXPECT_EQ(layer.output(), QStringLiteral("sRGB"));
  const QImage whole = layer_painted(layer, {600, 600}, {0, 0, 600, 600});
  for (const QPoint& lost : {QPoint(10, 10), QPoint(599, 599), QPoint(300, 0)})
    EXPECT_EQ(whole.pixel(lost), gamut_mark);
  EXPECT_NE(whole.pixel(11, 10), gamut_mark);
  EXPECT_EQ(layer_painted(layer, {150, 150}, {0, 0, 150, 150}).pixel(75, 0), gamut_mark)
      << "one of sixteen is enough";

  layer.set_viewing({.stops = 2, .gamut = true});
  ASSERT_TRUE(QTest::qWaitFor([&] { return layer.outside().has_value(); }));
  EXPECT_EQ(*layer.outside(), 600U * 600) << "all is too bright";
}

TEST(XyzLayer, AVeryWideViewIsOfALevelThatFitsIntoTheCache) {
  for (const double scale : {64.0, 1.0, 0.9, 0.5, 0.3, 0.01})
    for (const QSizeF& seen : {QSizeF(300, 200), QSizeF(1280, 800), QSizeF(3840, 2160)}) {
      const int level = level_of(scale, seen);
      const double side = std::ldexp(scale, level);
      EXPECT_LE(4 * seen.width() * seen.height() / (side * side), XyzLayer::most_bytes / 2.0);
      EXPECT_GE(level, 0);
    }
  EXPECT_EQ(level_of(1, {1280, 800}), 0);
  EXPECT_EQ(level_of(0.5, {1280, 800}), 1);
}

}  // namespace
}  // namespace metamer::gui
