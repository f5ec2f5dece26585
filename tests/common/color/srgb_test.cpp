#include "common/color/srgb.h"

#include <gtest/gtest.h>

#include <cmath>

namespace metamer {
namespace {

TEST(Srgb, HasThePublishedMatrices) {
  // IEC 61966-2-1, equations 7 and 8 (of its amendment), to their four digits.
  const srgb::Matrix3 to = {
      {{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}};
  const srgb::Matrix3 from = {
      {{3.2406, -1.5372, -0.4986}, {-0.9689, 1.8758, 0.0415}, {0.0557, -0.2040, 1.0570}}};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      EXPECT_NEAR(srgb::to_xyz_matrix()[row][column], to[row][column], 5.1e-5);
      // The standard inverts its rounded matrix, which costs the inverse a few of the last digit.
      EXPECT_NEAR(srgb::from_xyz_matrix()[row][column], from[row][column], 4e-4);
    }
  }
}

TEST(Srgb, WhiteIsD65AndPrimariesAreTheStandards) {
  const Xyz white = srgb::to_xyz({1, 1, 1});
  EXPECT_NEAR(white[0], 0.3127 / 0.3290, 1e-15);
  EXPECT_NEAR(white[1], 1, 1e-15);
  EXPECT_NEAR(white[2], (1 - 0.3127 - 0.3290) / 0.3290, 1e-15);
  const double x[] = {0.64, 0.30, 0.15}, y[] = {0.33, 0.60, 0.06};
  for (std::size_t c = 0; c < 3; ++c) {
    srgb::Rgb primary{};
    primary[c] = 1;
    const Xyz xyz = srgb::to_xyz(primary);
    const double sum = xyz[0] + xyz[1] + xyz[2];
    EXPECT_NEAR(xyz[0] / sum, x[c], 1e-15);
    EXPECT_NEAR(xyz[1] / sum, y[c], 1e-15);
  }
}

TEST(Srgb, MatricesAreEachOthersInverse) {
  for (const srgb::Rgb& rgb : {srgb::Rgb{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-0.5, 2, 0.25}}) {
    const srgb::Rgb back = srgb::from_xyz(srgb::to_xyz(rgb));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(back[c], rgb[c], 1e-14);
  }
}

TEST(SrgbTransfer, HasThePublishedFormula) {
  EXPECT_EQ(srgb::encode(0), 0);
  EXPECT_NEAR(srgb::encode(1), 1, 1e-15);
  EXPECT_NEAR(srgb::encode(0.002), 0.02584, 1e-15);
  EXPECT_NEAR(srgb::encode(0.18), 1.055 * std::pow(0.18, 1 / 2.4) - 0.055, 1e-15);
  EXPECT_NEAR(srgb::decode(0.5), 0.21404114048223255, 1e-15);
}

TEST(SrgbTransfer, IsContinuousAtTheKnee) {
  // The standard's rounded constants leave a step of 3e-8: a hundred-thousandth of an 8-bit step.
  const double knee = 0.0031308;
  EXPECT_NEAR(srgb::encode(knee), srgb::encode(std::nextafter(knee, 1)), 1e-7);
  const double encoded = 12.92 * knee;
  EXPECT_NEAR(srgb::decode(encoded), srgb::decode(std::nextafter(encoded, 1)), 1e-8);
}

TEST(SrgbTransfer, HasAnInverseEverywhere) {
  for (int i = -3000; i <= 3000; ++i) {
    const double value = i / 1000.0;
    EXPECT_NEAR(srgb::decode(srgb::encode(value)), value, 4e-15 + 2e-15 * std::abs(value)) << value;
    EXPECT_NEAR(srgb::encode(srgb::decode(value)), value, 4e-15 + 2e-15 * std::abs(value)) << value;
  }
}

TEST(SrgbTransfer, IsOddAndRises) {
  double before = srgb::encode(-2.0);
  for (int i = -1999; i <= 2000; ++i) {
    const double value = i / 1000.0;
    EXPECT_EQ(srgb::encode(-value), -srgb::encode(value));
    EXPECT_EQ(srgb::decode(-value), -srgb::decode(value));
    EXPECT_GT(srgb::encode(value), before);
    before = srgb::encode(value);
  }
}

}  // namespace
}  // namespace metamer
