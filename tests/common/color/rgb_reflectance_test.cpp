// What a colour becomes is seen as that colour again.
#include "common/color/rgb_reflectance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/color/lab.h"
#include "common/color/srgb.h"
#include "common/color/xyz.h"
#include "common/spectral/cie.h"

namespace metamer {
namespace {

/// X Y Z under D65, of white 1.
Xyz xyz_seen(const Spectrum& reflectance) {
  const ObserverWeights lit =
      under_light(cie::observer_1931(), *cie::illuminant("D65"), reflectance.nm);
  return to_xyz(lit, reflectance.values);
}

TEST(RgbReflectance, IsSeenAsItsColour) {
  const Xyz white = xyz_seen(reflectance_of_rgb({1, 1, 1}));
  double worst = 0;
  for (int r = 0; r <= 10; ++r)
    for (int g = 0; g <= 10; ++g)
      for (int b = 0; b <= 10; ++b) {
        // By steps that look alike, to the corners of the gamut.
        const Rgb linear = {std::pow(r / 10.0, 2.2), std::pow(g / 10.0, 2.2),
                            std::pow(b / 10.0, 2.2)};
        const Spectrum reflectance = reflectance_of_rgb(linear);
        const auto [low, high] =
            std::minmax_element(reflectance.values.begin(), reflectance.values.end());
        ASSERT_GE(*low, 0);
        ASSERT_LE(*high, 1);
        const Lab wanted = to_lab(srgb::to_xyz(linear), srgb::to_xyz({1, 1, 1}));
        worst = std::max(worst, delta_e_00(to_lab(xyz_seen(reflectance), white), wanted));
      }
  EXPECT_LT(worst, 0.1);
  RecordProperty("largest", std::to_string(worst));
}

TEST(RgbReflectance, OfANeutralIsTheSameEverywhere) {
  for (const double grey : {0.0, 0.18, 0.5, 1.0})
    for (const double value : reflectance_of_rgb({grey, grey, grey}).values)
      EXPECT_NEAR(value, grey, 1e-15);
}

TEST(RgbReflectance, IsLinearInItsColour) {
  const Spectrum mixed = reflectance_of_rgb({0.25, 0.5, 0.125});
  const Spectrum red = reflectance_of_rgb({1, 0, 0}), green = reflectance_of_rgb({0, 1, 0}),
                 blue = reflectance_of_rgb({0, 0, 1});
  for (std::size_t i = 0; i < mixed.nm.size(); ++i)
    EXPECT_NEAR(mixed.values[i],
                0.25 * red.values[i] + 0.5 * green.values[i] + 0.125 * blue.values[i], 1e-15);
}

TEST(RgbReflectance, IsSmooth) {
  // Measured paints change by less than that in 10 nm, too.
  for (const Rgb& primary : {Rgb{1, 0, 0}, Rgb{0, 1, 0}, Rgb{0, 0, 1}}) {
    const std::vector<double> values = reflectance_of_rgb(primary).values;
    for (std::size_t i = 1; i < values.size(); ++i)
      EXPECT_LT(std::abs(values[i] - values[i - 1]), 0.3);
  }
}

}  // namespace
}  // namespace metamer
