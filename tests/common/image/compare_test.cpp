#include "common/image/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/color/lab.h"
#include "common/color/srgb.h"

namespace metamer {
namespace {

const Xyz white = srgb::to_xyz({1, 1, 1});

/// The colour of a Lab triplet by the inverse of CIE 15:2004, 8.2.1, above its line.
Xyz from_lab(const Lab& lab) {
  const double y = (lab.l + 16) / 116, x = y + lab.a / 500, z = y - lab.b / 200;
  return {white[0] * x * x * x, white[1] * y * y * y, white[2] * z * z * z};
}

Image picture(int width, int height, const std::vector<Xyz>& pixels) {
  Image image = make_image(width, height, {"X", "Y", "Z"});
  for (std::size_t i = 0; i < pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) image.pixels[3 * i + c] = static_cast<float>(pixels[i][c]);
  return image;
}

TEST(Compare, AgreesWithPublishedPairsAndFindsTheLargest) {
  // Sharma, Wu and Dalal (2005), table 1, pairs 1, 25 and 17.
  const std::vector<Lab> a = {{50, 2.6772, -79.7751}, {60.2574, -34.0099, 36.2677}, {50, 2.5, 0}};
  const std::vector<Lab> b = {{50, 0, -82.7485}, {60.4626, -34.1751, 39.4387}, {73, 25, -18}};
  const std::vector<double> published = {2.0425, 1.2644, 27.1492};
  std::vector<Xyz> one, other;
  for (std::size_t i = 0; i < a.size(); ++i) {
    one.push_back(from_lab(a[i]));
    other.push_back(from_lab(b[i]));
  }
  const auto difference = compare(picture(1, 3, one), picture(1, 3, other), Metric::de00, white);
  ASSERT_TRUE(difference);
  for (std::size_t i = 0; i < published.size(); ++i)
    EXPECT_NEAR(difference->values[i], published[i], 2e-4) << i;
  EXPECT_EQ(difference->statistics.at, 2u);
}

TEST(Compare, OfLightnessAloneIsItsDifferenceInTheOlderMetrics) {
  // Greys differ in L* only; L* is 116 ∛Y − 16.
  const Image a = picture(1, 1, {white});
  const Image b = picture(1, 1, {{white[0] / 8, white[1] / 8, white[2] / 8}});
  for (const Metric metric : {Metric::deab, Metric::deuv}) {
    const auto difference = compare(a, b, metric, white);
    ASSERT_TRUE(difference);
    EXPECT_NEAR(difference->values[0], 58, 2e-5) << name_of(metric);
  }
}

TEST(Compare, OfAPictureWithItselfIsZeroEverywhere) {
  const Image a = picture(2, 1, {{0.2, 0.4, 0.1}, {0, 0, 0}});
  for (const Metric metric : {Metric::de00, Metric::deab, Metric::deuv}) {
    const auto difference = compare(a, a, metric, white);
    ASSERT_TRUE(difference);
    EXPECT_EQ(difference->statistics.maximum, 0) << name_of(metric);
    EXPECT_EQ(difference->statistics.count, 2u);
  }
}

TEST(Compare, PlacesWhatIsNotFiniteInEitherPicture) {
  Image a = picture(3, 2, std::vector<Xyz>(6, {0.2, 0.2, 0.2})), b = a;
  a.at(2, 1)[1] = std::numeric_limits<float>::quiet_NaN();
  b.at(1, 0)[2] = std::numeric_limits<float>::infinity();
  const auto difference = compare(a, b, Metric::de00, white);
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->statistics.not_finite, 2u);
  EXPECT_EQ(difference->statistics.first_not_finite, 1u);
  EXPECT_EQ(difference->statistics.count, 4u);
  EXPECT_EQ(difference->statistics.mean, 0);
}

TEST(Compare, RefusesPicturesOfDifferentSize) {
  const auto difference = compare(make_image(3, 2, {"X", "Y", "Z"}),
                                  make_image(2, 3, {"X", "Y", "Z"}), Metric::de00, white);
  ASSERT_FALSE(difference);
  EXPECT_EQ(difference.error().message, "the pictures differ in size: 3 × 2 and 2 × 3 pixels");
}

/// Encoded sRGB at a pixel, 0 to 255.
std::array<long, 3> encoded(const Image& image, int x, int y) {
  const float* xyz = image.at(x, y);
  const srgb::Rgb rgb = srgb::from_xyz({xyz[0], xyz[1], xyz[2]});
  std::array<long, 3> bytes{};
  for (std::size_t c = 0; c < 3; ++c) bytes[c] = std::lround(255 * srgb::encode(rgb[c]));
  return bytes;
}

TEST(FalseColor, GoesFromBlackToWhiteAndMarksWhatIsNoNumber) {
  Difference difference;
  difference.width = 500;
  difference.height = 1;
  difference.values.assign(500, 0.0);
  difference.values[1] = 2;
  difference.values[2] = 200;
  difference.values[3] = std::numeric_limits<double>::quiet_NaN();
  difference.values[4] = 1;
  difference.statistics = error_statistics(difference.values);
  const auto drawn = false_color(difference, Metric::de00, 2, "a and b");
  ASSERT_TRUE(drawn) << format(drawn.error());
  EXPECT_EQ(drawn->width, 500);
  EXPECT_GT(drawn->height, 1) << "no legend";
  using Rgb = std::array<long, 3>;
  EXPECT_EQ(encoded(*drawn, 0, 0), (Rgb{0, 0, 0}));
  EXPECT_EQ(encoded(*drawn, 1, 0), (Rgb{255, 255, 255}));
  EXPECT_EQ(encoded(*drawn, 2, 0), (Rgb{255, 255, 255}));
  EXPECT_EQ(encoded(*drawn, 3, 0), (Rgb{255, 0, 0}));
  // Green's colours at one half, by hand: the angle is 2π(0.5/3 − 0.75), the deviation 1/8.
  EXPECT_EQ(encoded(*drawn, 4, 0), (Rgb{160, 121, 73}));
}

TEST(FalseColor, GetsLighterAllTheWayUp) {
  Difference difference;
  difference.width = 1000;
  difference.height = 1;
  for (int i = 0; i < 1000; ++i) difference.values.push_back(i);
  difference.statistics = error_statistics(difference.values);
  const auto drawn = false_color(difference, Metric::de00, 999, "");
  ASSERT_TRUE(drawn);
  // Green made it so that 0.30 R + 0.59 G + 0.11 B of the encoded values rises.
  double last = -1;
  for (int x = 0; x < 1000; x += 10) {
    const auto rgb = encoded(*drawn, x, 0);
    const double brightness = 0.30 * static_cast<double>(rgb[0]) +
                              0.59 * static_cast<double>(rgb[1]) +
                              0.11 * static_cast<double>(rgb[2]);
    EXPECT_GT(brightness, last) << x;
    last = brightness;
  }
}

}  // namespace
}  // namespace metamer
