#include "client/tools/pictures/pixel_reading.h"

#include <gtest/gtest.h>

#include "common/color/srgb.h"

namespace metamer::client {
namespace {

TEST(PixelReading, OfWhiteIsWhite) {
  const Xyz white = srgb::to_xyz({1, 1, 1});
  const PixelReading reading = read_color(white, white, {});
  ASSERT_TRUE(reading.lab);
  EXPECT_NEAR(reading.lab->l, 100, 1e-9);
  EXPECT_NEAR(reading.lab->a, 0, 1e-9);
  for (const double value : reading.encoded) EXPECT_NEAR(value, 1, 1e-9);
  EXPECT_TRUE(reading.in_gamut);
}

TEST(PixelReading, OutOfGamutIsWhatAPngWouldClip) {
  const auto in_gamut = [](const Rgb& linear) {
    return read_color(srgb::to_xyz(linear), std::nullopt, {}).in_gamut;
  };
  EXPECT_TRUE(in_gamut({0, 0.5, 1}));
  EXPECT_TRUE(in_gamut({-1e-5, 0.5, 1.001}));  // less than half a step
  EXPECT_FALSE(in_gamut({-0.01, 0.5, 0.5}));
  EXPECT_FALSE(in_gamut({0.5, 0.5, 1.1}));
  EXPECT_FALSE(in_gamut({std::numeric_limits<double>::quiet_NaN(), 0.5, 0.5}));
}

TEST(PixelReading, WithoutAWhiteThereIsNoLab) {
  EXPECT_FALSE(read_color({0.2, 0.2, 0.2}, std::nullopt, {}).lab);
  EXPECT_FALSE(read_color({0.2, 0.2, 0.2}, Xyz{0, 1, 1}, {}).lab);
}

TEST(PixelReading, TheSquareIsCutAtThePicturesEdges) {
  Image image = make_image(5, 4, {"X", "Y", "Z"});
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x) image.at(x, y)[1] = static_cast<float>(10 * y + x);
  EXPECT_EQ(mean_xyz(image, 2, 1, 1)[1], 12);
  EXPECT_EQ(mean_xyz(image, 2, 1, 3)[1], 12);
  EXPECT_EQ(mean_xyz(image, 0, 0, 3)[1], 5.5);   // of 0 1 10 11
  EXPECT_EQ(mean_xyz(image, 2, 1, 2)[1], 17.5);  // to the right and down
  EXPECT_EQ(mean_xyz(image, 2, 2, 64)[1], 17);
}

TEST(PixelReading, TheSpreadIsTheStandardDeviationOfTheSquaresPixels) {
  Image image = make_image(5, 4, {"X", "Y", "Z"});
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x) image.at(x, y)[1] = static_cast<float>(10 * y + x);
  EXPECT_EQ(spread_xyz(image, 2, 1, 1)[1], 0);
  // numpy.std of 0 1 10 11, and of all twenty.
  EXPECT_DOUBLE_EQ(spread_xyz(image, 0, 0, 3)[1], 5.024937810560445);
  EXPECT_DOUBLE_EQ(spread_xyz(image, 2, 2, 64)[1], 11.269427669584644);
  EXPECT_EQ(spread_xyz(image, 2, 2, 64)[0], 0);
}

}  // namespace
}  // namespace metamer::client
