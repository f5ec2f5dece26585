#include "common/color/chromaticity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/color/radiators.h"

namespace metamer {
namespace {

Chromaticity seen(const Spectrum& light) {
  const Wavelengths wavelengths = *Wavelengths::uniform(380, 780, 5);
  return *chromaticity(to_xyz(observer_weights(cie::observer_1931(), wavelengths),
                              resample(light, wavelengths.nm(), Outside::zero).values));
}

Chromaticity body(double kelvin) {
  const Wavelengths wavelengths = *Wavelengths::uniform(360, 830, 5);
  return *chromaticity(to_xyz(observer_weights(cie::observer_1931(), wavelengths),
                              planckian(kelvin, wavelengths.nm()).values));
}

TEST(Chromaticity, OfEqualEnergyIsTheMiddle) {
  const Chromaticity c = *chromaticity({0.7, 0.7, 0.7});
  EXPECT_DOUBLE_EQ(c.x, 1.0 / 3);
  EXPECT_DOUBLE_EQ(c.y, 1.0 / 3);
  // CIE 15:2004, table T.3: u' 0.2105, v' 0.4737.
  EXPECT_NEAR(uv_1976(c).u, 0.2105, 5e-5);
  EXPECT_NEAR(uv_1976(c).v, 0.4737, 5e-5);
  EXPECT_DOUBLE_EQ(uv_1960(c).v, uv_1976(c).v / 1.5);
}

TEST(Chromaticity, OfBlackIsNone) {
  EXPECT_FALSE(chromaticity({0, 0, 0}));
  EXPECT_FALSE(chromaticity({1, -2, 0}));
  EXPECT_FALSE(chromaticity({std::nan(""), 1, 1}));
  EXPECT_TRUE(chromaticity({1e-300, 1e-300, 1e-300}));
}

struct Published {
  const char* light;
  double kelvin, tolerance;
};

TEST(ColorTemperature, IsThePublishedOne) {
  // CIE 15:2004, tables T.3 (A, D; 2856 is A's with c₂ = 1.4388e-2) and T.8 (F, rounded to tens);
  // B and C: Wyszecki and Stiles (1982), 3.3.4.
  for (const Published& one : std::vector<Published>{{"A", 2856, 1},
                                                     {"B", 4874, 5},
                                                     {"C", 6774, 5},
                                                     {"D50", 5003, 3},
                                                     {"D55", 5503, 3},
                                                     {"D65", 6504, 3},
                                                     {"F1", 6430, 10},
                                                     {"F2", 4230, 10},
                                                     {"F3", 3450, 10},
                                                     {"F4", 2940, 10},
                                                     {"F5", 6350, 10},
                                                     {"F6", 4150, 10},
                                                     {"F7", 6500, 10},
                                                     {"F8", 5000, 10},
                                                     {"F9", 4150, 10},
                                                     {"F10", 5000, 20},
                                                     {"F11", 4000, 10},
                                                     {"F12", 3000, 10}}) {
    const auto found = color_temperature(seen(*cie::illuminant(one.light)));
    ASSERT_TRUE(found) << one.light;
    EXPECT_NEAR(found->kelvin, one.kelvin, one.tolerance) << one.light;
  }
}

TEST(ColorTemperature, OfABlackBodyIsItsOwn) {
  for (const double kelvin : {1050.0, 2000.0, 2856.0, 5000.0, 10000.0, 40000.0, 300000.0}) {
    const auto found = color_temperature(body(kelvin));
    ASSERT_TRUE(found) << kelvin;
    EXPECT_NEAR(1e6 / found->kelvin, 1e6 / kelvin, 1e-5);
    EXPECT_NEAR(found->duv, 0, 1e-9);
  }
}

/// CIE 1960 u, v back to x, y.
Chromaticity from_uv(const Uv& uv) {
  const double sum = 2 * uv.u - 8 * uv.v + 4;
  return {3 * uv.u / sum, 2 * uv.v / sum};
}

TEST(ColorTemperature, StaysTheSameSquareToTheLocus) {
  for (const double kelvin : {1500.0, 3000.0, 6500.0, 20000.0}) {
    const Uv middle = uv_1960(body(kelvin)), hotter = uv_1960(body(kelvin * 1.0001)),
             colder = uv_1960(body(kelvin / 1.0001));
    const double du = hotter.u - colder.u, dv = hotter.v - colder.v, length = std::hypot(du, dv);
    for (const double duv : {-0.02, -0.003, 0.003, 0.02}) {
      // From hot to cold, up and to the left is above.
      const double sign = du < 0 ? 1 : -1;
      const Uv off = {middle.u + sign * duv * dv / length, middle.v - sign * duv * du / length};
      const auto found = color_temperature(from_uv(off));
      ASSERT_TRUE(found) << kelvin;
      EXPECT_NEAR(1e6 / found->kelvin, 1e6 / kelvin, 2e-3) << duv;
      EXPECT_NEAR(found->duv, duv, 1e-9);
    }
  }
}

TEST(ColorTemperature, OfColouredLightIsNone) {
  EXPECT_FALSE(color_temperature({0.64, 0.33})) << "red: below 1,000 K";
  EXPECT_FALSE(color_temperature({0.30, 0.60})) << "green: too far from any black body";
  EXPECT_FALSE(color_temperature({0.15, 0.06})) << "blue";
  EXPECT_FALSE(color_temperature(body(900)));
}

TEST(Radiators, AreThePublishedOnes) {
  // CIE 15:2004, 3.1: A is defined by the exponent 1.435e7 / (2848 λ).
  for (const double nm : {300.0, 380.0, 450.0, 560.0, 700.0, 830.0}) {
    const double a = std::pow(560 / nm, 5) * std::expm1(1.435e7 / (2848 * 560)) /
                     std::expm1(1.435e7 / (2848 * nm));
    EXPECT_NEAR(planckian(2848 * 1.4388 / 1.4350, {nm}).values[0], a, 1e-12 * a);
  }
  // D65 was tabulated with the older temperature, 6500 K × 1.4388 / 1.4380, and rounded M.
  const Spectrum& d65 = *cie::illuminant("D65");
  const Spectrum own = daylight(6500 * 1.4388 / 1.4380, d65.nm);
  for (std::size_t i = 0; i < d65.nm.size(); ++i)
    EXPECT_NEAR(own.values[i], d65.values[i], 2e-3) << d65.nm[i];
  EXPECT_EQ(daylight(5000, {299, 831}).values, (std::vector<double>{0, 0}));
}

}  // namespace
}  // namespace metamer
