#include "common/color/lab.h"

#include <gtest/gtest.h>

#include <cmath>

namespace metamer {
namespace {

/// G. Sharma, W. Wu and E. N. Dalal, Color Research and Application 30, 21 (2005), Table 1.
struct Pair {
  Lab one, other;
  double difference;
};

const Pair pairs[] = {
    {{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
    {{50, 3.1571, -77.2803}, {50, 0, -82.7485}, 2.8615},
    {{50, 2.8361, -74.0200}, {50, 0, -82.7485}, 3.4412},
    {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1.0000},
    {{50, -1.1848, -84.8006}, {50, 0, -82.7485}, 1.0000},
    {{50, -0.9009, -85.5211}, {50, 0, -82.7485}, 1.0000},
    {{50, 0, 0}, {50, -1, 2}, 2.3669},
    {{50, -1, 2}, {50, 0, 0}, 2.3669},
    {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0009}, 7.1792},
    {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0010}, 7.1792},
    {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0011}, 7.2195},
    {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0012}, 7.2195},
    {{50, -0.0010, 2.4900}, {50, 0.0009, -2.4900}, 4.8045},
    {{50, -0.0010, 2.4900}, {50, 0.0010, -2.4900}, 4.8045},
    {{50, -0.0010, 2.4900}, {50, 0.0011, -2.4900}, 4.7461},
    {{50, 2.5000, 0}, {50, 0, -2.5000}, 4.3065},
    {{50, 2.5000, 0}, {73, 25, -18}, 27.1492},
    {{50, 2.5000, 0}, {61, -5, 29}, 22.8977},
    {{50, 2.5000, 0}, {56, -27, -3}, 31.9030},
    {{50, 2.5000, 0}, {58, 24, 15}, 19.4535},
    {{50, 2.5000, 0}, {50, 3.1736, 0.5854}, 1.0000},
    {{50, 2.5000, 0}, {50, 3.2972, 0}, 1.0000},
    {{50, 2.5000, 0}, {50, 1.8634, 0.5757}, 1.0000},
    {{50, 2.5000, 0}, {50, 3.2592, 0.3350}, 1.0000},
    {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
    {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.2630},
    {{61.2901, 3.7196, -5.3901}, {61.4292, 2.2480, -4.9620}, 1.8731},
    {{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
    {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
    {{36.4612, 47.8580, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
    {{90.8027, -2.0831, 1.4410}, {91.1528, -1.6435, 0.0447}, 1.4441},
    {{90.9257, -0.5406, -0.9208}, {88.6381, -0.8985, -0.7239}, 1.5381},
    {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
    {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
};

TEST(DeltaE00, IsThatOfThePublishedPairsBothWays) {
  static_assert(std::size(pairs) == 34);
  for (const Pair& pair : pairs) {
    EXPECT_NEAR(delta_e_00(pair.one, pair.other), pair.difference, 5e-5);
    EXPECT_NEAR(delta_e_00(pair.other, pair.one), pair.difference, 5e-5);
    EXPECT_EQ(delta_e_00(pair.one, pair.one), 0);
  }
}

const Xyz d65 = {0.95047, 1, 1.08883};

TEST(Lab, OfTheWhiteIsA100AndOfBlackA0) {
  const Lab white = to_lab(d65, d65), black = to_lab({0, 0, 0}, d65);
  EXPECT_NEAR(white.l, 100, 1e-12);
  EXPECT_NEAR(white.a, 0, 1e-12);
  EXPECT_NEAR(white.b, 0, 1e-12);
  EXPECT_NEAR(black.l, 0, 1e-12);
  EXPECT_NEAR(black.a, 0, 1e-12);
  const Luv dark = to_luv({0, 0, 0}, d65);
  EXPECT_NEAR(dark.l, 0, 1e-12);
  EXPECT_EQ(dark.u, 0);
  EXPECT_EQ(dark.v, 0);
}

TEST(Lab, IsContinuousWhereTheCubeRootBegins) {
  const double edge = 216.0 / 24389;
  const double below = to_lab({0, edge * (1 - 1e-9), 0}, d65).l;
  const double above = to_lab({0, edge * (1 + 1e-9), 0}, d65).l;
  EXPECT_NEAR(below, 8, 1e-6);
  EXPECT_NEAR(above, 8, 1e-6);
}

TEST(Lab, OfSrgbRedIsTheKnownOne) {
  // XYZ of sRGB's red, IEC 61966-2-1.
  const Lab red = to_lab({0.4124564, 0.2126729, 0.0193339}, d65);
  EXPECT_NEAR(red.l, 53.24, 0.01);
  EXPECT_NEAR(red.a, 80.09, 0.01);
  EXPECT_NEAR(red.b, 67.20, 0.01);
  const Luv luv = to_luv({0.4124564, 0.2126729, 0.0193339}, d65);
  EXPECT_NEAR(luv.u, 175.01, 0.02);
  EXPECT_NEAR(luv.v, 37.76, 0.02);
}

TEST(DeltaE, Of1976IsTheDistance) {
  EXPECT_DOUBLE_EQ(delta_e_ab({50, 1, 2}, {53, 5, 14}), 13);
  EXPECT_DOUBLE_EQ(delta_e_uv({50, 1, 2}, {53, 5, 14}), 13);
}

}  // namespace
}  // namespace metamer
