// Sunlight, against what others measured of the air.

#include "common/color/sunlight.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/color/illuminants.h"
#include "common/color/xyz.h"
#include "common/spectral/cie.h"

namespace metamer {
namespace {

double at(const Spectrum& spectrum, double nm) {
  return resample(spectrum, {nm}, Outside::zero).values.front();
}

/// Per air mass, by sunlight of two elevations (F. Kasten and A. T. Young, Appl. Opt. 28, 4735
/// (1989): 1.0000 from the zenith, 1.9939 at 30°).
double optical_depth(double nm, double turbidity) {
  return std::log(at(sunlight(turbidity, 90), nm) / at(sunlight(turbidity, 30), nm)) /
         (1.9939 - 1.0000);
}

TEST(Sunlight, IsScatteredByMoleculesAsBodhaineAndOthersHaveIt) {
  // B. A. Bodhaine et al., J. Atmos. Ocean. Technol. 16, 1854 (1999), 30, at 1013.25 hPa; beside it
  // Ångström's haze of turbidity 2, 0.0463 λ^-1.3, and ozone of 0.35 cm (A. Vigroux).
  for (const auto& [nm, rayleigh, ozone] :
       {std::array{400.0, 0.3602, 0.0}, {550.0, 0.0971, 0.085}, {700.0, 0.0364, 0.023}}) {
    const double haze = 0.0463 * std::pow(nm / 1000, -1.3), vapour = nm == 700 ? 0.005 : 0;
    const double expected = rayleigh + haze + 0.35 * ozone + vapour;
    EXPECT_NEAR(optical_depth(nm, 2), expected, 0.04 * expected) << nm;
  }
}

TEST(Sunlight, HasTheBandsOfOxygenAndWater) {
  const Spectrum sun = sunlight(3, 60);
  EXPECT_LT(at(sun, 760), 0.8 * at(sun, 750));  // A band
  EXPECT_LT(at(sun, 720), 0.9 * at(sun, 710));
}

TEST(Sunlight, IsWarmerTheLowerTheSunAndTheHazierTheAir) {
  const auto x = [](double turbidity, double elevation) {
    const Xyz xyz = emission_xyz(sunlight(turbidity, elevation), cie::observer_1931());
    return xyz[0] / (xyz[0] + xyz[1] + xyz[2]);
  };
  // At noon about as a black body of 5,200 to 5,800 K.
  EXPECT_GT(x(2, 90), 0.326);
  EXPECT_LT(x(2, 90), 0.340);
  for (double elevation = 90; elevation > 5; elevation -= 5)
    for (double turbidity = 2; turbidity < 10; ++turbidity) {
      EXPECT_LT(x(turbidity, elevation), x(turbidity, elevation - 5));
      EXPECT_LT(x(turbidity, elevation), x(turbidity + 1, elevation));
    }
}

TEST(Sunlight, HasAName) {
  const auto named = illuminant_named("sun:2.5:30");
  ASSERT_TRUE(named);
  EXPECT_EQ(named->values, sunlight(2.5, 30).values);
  EXPECT_TRUE(names_formula("sun:2.5:30"));
  for (const char* wrong : {"sun:", "sun:3", "sun:3:", "sun::45", "sun:3:45x", "sun"})
    EXPECT_FALSE(illuminant_named(wrong)) << wrong;
  EXPECT_EQ(illuminant_named("sun:1:30").error().message,
            "\"sun:1:30\" is out of range: sunlight has a turbidity of 2 to 10 and an elevation of "
            "0 to 90 degrees");
  EXPECT_FALSE(illuminant_named("sun:3:91"));
}

TEST(Sunlight, OnTheHorizonIsLightStill) {
  for (const double turbidity : {2.0, 10.0}) {
    const Spectrum sun = sunlight(turbidity, 0);
    for (const double value : sun.values) {
      EXPECT_TRUE(std::isfinite(value));
      EXPECT_GT(value, 0);
    }
    EXPECT_GT(at(sun, 700), 10 * at(sun, 450));
  }
}

}  // namespace
}  // namespace metamer
