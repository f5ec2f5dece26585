#include "common/color/rgb_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace metamer {
namespace {

void expect_matrix(StandardSpace space, const Matrix3& published, double tolerance) {
  const RgbSpace& own = rgb_space(space);
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      EXPECT_NEAR(own.to_xyz[row][column], published[row][column], tolerance)
          << own.name << " " << row << " " << column;
}

TEST(RgbSpace, HasThePublishedMatrices) {
  // W3C, CSS Color Module Level 4, 17 (sample code), from the same chromaticities.
  expect_matrix(StandardSpace::display_p3,
                {{{0.4865709486, 0.2656676932, 0.1982172852},
                  {0.2289745641, 0.6917385218, 0.0792869141},
                  {0, 0.0451133819, 1.0439443689}}},
                1e-9);
  expect_matrix(StandardSpace::rec_2020,
                {{{0.6369580483, 0.1446169036, 0.1688809752},
                  {0.2627002120, 0.6779980715, 0.0593017165},
                  {0, 0.0280726930, 1.0609850577}}},
                1e-9);
  // Adobe RGB (1998) Color Image Encoding, 4.3.5.3.
  expect_matrix(
      StandardSpace::adobe_rgb,
      {{{0.57667, 0.18556, 0.18823}, {0.29734, 0.62736, 0.07529}, {0.02703, 0.07069, 0.99134}}},
      1e-5);
  // ISO 22028-2: four digits.
  expect_matrix(StandardSpace::prophoto,
                {{{0.7977, 0.1352, 0.0313}, {0.2880, 0.7119, 0.0001}, {0, 0, 0.8249}}}, 3e-4);
  // E[3.1-16].
  expect_matrix(StandardSpace::cie_rgb,
                {{{0.49, 0.31, 0.20}, {0.17697, 0.81240, 0.01063}, {0, 0.01, 0.99}}}, 1e-5);
}

TEST(RgbSpace, OfAllOnesIsItsWhiteAndMatricesInvertEachOther) {
  for (const std::string& word : rgb_space_words()) {
    const RgbSpace& space = *find_rgb_space(word);
    const Xyz white = multiply(space.to_xyz, Rgb{1, 1, 1});
    const Xyz expected = white_xyz(space.primaries.white);
    const Rgb back = multiply(space.from_xyz, multiply(space.to_xyz, Rgb{-0.5, 2, 0.25}));
    const Rgb there = {-0.5, 2, 0.25};
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(white[c], expected[c], 1e-14) << word;
      EXPECT_NEAR(back[c], there[c], 1e-13) << word;
    }
  }
  EXPECT_EQ(find_rgb_space("sRGB"), nullptr);
}

TEST(RgbSpaceTransfer, IsTheStandards) {
  const auto code = [](StandardSpace space, double linear) {
    return encode(rgb_space(space).transfer, linear);
  };
  // Adobe RGB (1998) 4.3.4.2: a power of 2 51/256.
  EXPECT_DOUBLE_EQ(code(StandardSpace::adobe_rgb, 0.5), std::pow(0.5, 256.0 / 563));
  // ISO 22028-2: 16 C below 1/512, where C^(1/1.8) meets it.
  EXPECT_DOUBLE_EQ(code(StandardSpace::prophoto, 0.001), 0.016);
  EXPECT_NEAR(code(StandardSpace::prophoto, 1.0 / 512 + 1e-15), 1.0 / 32, 1e-12);
  // ITU-R BT.2020-2, table 4.
  EXPECT_DOUBLE_EQ(code(StandardSpace::rec_2020, 0.01), 0.045);
  EXPECT_NEAR(code(StandardSpace::rec_2020, 0.5), 1.0993 * std::pow(0.5, 0.45) - 0.0993, 1e-5);
  const double beta = 0.018053968510807;
  EXPECT_NEAR(code(StandardSpace::rec_2020, beta * (1 + 1e-12)), 4.5 * beta, 1e-12);
  // Display P3 has the curve of sRGB; CIE RGB none.
  EXPECT_DOUBLE_EQ(code(StandardSpace::display_p3, 0.5), 1.055 * std::pow(0.5, 1 / 2.4) - 0.055);
  EXPECT_DOUBLE_EQ(code(StandardSpace::cie_rgb, 0.3), 0.3);
}

TEST(RgbSpaceTransfer, IsOddRisesAndHasAnInverseEverywhere) {
  for (const std::string& word : rgb_space_words()) {
    const Transfer& transfer = find_rgb_space(word)->transfer;
    double last = 0;
    for (double linear = 1e-6; linear < 4; linear *= 1.1) {
      const double encoded = encode(transfer, linear);
      EXPECT_GT(encoded, last) << word;
      last = encoded;
      EXPECT_NEAR(decode(transfer, encoded), linear, 1e-13 * std::max(1.0, linear)) << word;
      EXPECT_EQ(encode(transfer, -linear), -encoded) << word;
    }
    EXPECT_NEAR(encode(transfer, 1), 1, 1e-15) << word;
    EXPECT_EQ(encode(transfer, 0), 0) << word;
  }
}

std::string error_of(const Primaries& primaries, double gamma = 1) {
  const auto space = make_rgb_space("own", "own", primaries, {.gamma = gamma});
  return space ? "" : space.error().message;
}

TEST(RgbSpace, OfBadPrimariesIsAnError) {
  const Primaries good = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};
  EXPECT_EQ(error_of(good), "");
  Primaries bad = good;
  bad.green.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of(bad), "green must have x and y in -10..10 (one is nan)");
  bad = good;
  bad.red.x = 1e300;
  EXPECT_EQ(error_of(bad), "red must have x and y in -10..10 (one is 1e+300)");
  bad = good;
  bad.blue.y = 0;
  EXPECT_EQ(error_of(bad), "blue must have a y other than 0 (it is 0)");
  bad = good;
  bad.white.y = -0.1;
  EXPECT_EQ(error_of(bad), "white must have a y above 0 (it is -0.1)");
  bad = good;
  bad.green = {0.395, 0.195};
  EXPECT_EQ(error_of(bad), "red, green and blue must not lie on a line");
  bad = good;
  bad.white = {0.1, 0.6};
  EXPECT_EQ(error_of(bad), "white must lie inside the triangle of red, green and blue");
  bad.white = {0.395, 0.195};
  EXPECT_EQ(error_of(bad), "white must lie inside the triangle of red, green and blue");
  EXPECT_EQ(error_of(good, 0), "gamma must be above 0 (it is 0)");
}

TEST(RgbSpace, MayHaveImaginaryPrimaries) {
  // Academy S-2014-004 (AP0): the blue has a negative y.
  const auto aces = make_rgb_space(
      "own", "own", {{0.7347, 0.2653}, {0, 1}, {0.0001, -0.0770}, {0.32168, 0.33767}}, {});
  ASSERT_TRUE(aces) << aces.error().message;
  // SMPTE ST 2065-1, 4.4.
  EXPECT_NEAR(aces->to_xyz[0][0], 0.9525523959, 1e-9);
  EXPECT_NEAR(aces->to_xyz[1][1], 0.7281660966, 1e-9);
  EXPECT_NEAR(aces->to_xyz[2][2], 1.0088251844, 1e-9);
}

}  // namespace
}  // namespace metamer
