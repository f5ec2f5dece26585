// The sky by day: the paper's formulas, and the spectra that carry them.

#include "server/scene/environment/daylight_sky.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/color/xyz.h"
#include "common/scene/validate.h"
#include "common/spectral/cie.h"
#include "tests/server/test_scene.h"

namespace metamer {
namespace {

constexpr double pi = std::numbers::pi;

TEST(DaylightSky, HasItsZenithsColourAndLuminance) {
  // A.2 by hand, of turbidities 2, 3 and 6: x, y, kcd/m².
  struct Case {
    double turbidity, elevation, x, y, luminance;
  };
  for (const Case& one : {Case{2, 45, 0.2410, 0.2437, 4.47},
                          {3, 45, 0.2457, 0.2515, 7.32},
                          {3, 90, 0.2707, 0.2824, 29.48},
                          {6, 20, 0.2714, 0.2898, 6.58}}) {
    const DaylightSky sky(one.turbidity, one.elevation);
    const auto zenith = sky.at(1, std::cos(sky.sun_zenith()));
    EXPECT_NEAR(zenith.x, one.x, 1e-4);
    EXPECT_NEAR(zenith.y, one.y, 1e-4);
    EXPECT_NEAR(zenith.luminance, one.luminance, 6e-3);
  }
}

/// Its colour of what a painted sky has at a pixel, with its luminance.
DaylightSky::Colour painted_colour(const PaintedSky& painted, std::uint32_t x, std::uint32_t y) {
  Xyz sum{};
  for (std::size_t part = 0; part < 3; ++part) {
    const Xyz own = emission_xyz(painted.parts[part], cie::observer_1931());
    for (std::size_t i = 0; i < 3; ++i) sum[i] += double{painted.picture.at(x, y)[part]} * own[i];
  }
  const double whole = sum[0] + sum[1] + sum[2];
  return {sum[0] / whole, sum[1] / whole, sum[1]};
}

TEST(DaylightSky, IsPaintedInTheModelsColours) {
  for (const double turbidity : {2.0, 8.0})
    for (const double elevation : {30.0, 60.0}) {
      const DaylightSky sky(turbidity, elevation);
      const PaintedSky painted = paint(sky);
      const std::uint32_t width = painted.picture.width, height = painted.picture.height;
      for (std::uint32_t y = 3; y < height / 2; y += 41)
        for (std::uint32_t x = 5; x < width; x += 101) {
          const double zenith = (y + 0.5) * pi / height, turn = (x + 0.5) * 2 * pi / width - pi;
          const double sun = (90 - elevation) * pi / 180;
          const auto expected =
              sky.at(std::cos(zenith), std::sin(zenith) * std::sin(sun) * std::cos(turn) +
                                           std::cos(zenith) * std::cos(sun));
          const auto is = painted_colour(painted, x, y);
          // The CIE's formulas for daylight are rounded.
          EXPECT_NEAR(is.x, expected.x, 1e-3);
          EXPECT_NEAR(is.y, expected.y, 1e-3);
          EXPECT_NEAR(is.luminance, expected.luminance, 1e-5 * expected.luminance);
        }
    }
}

TEST(DaylightSky, IsLightEverywhereAboveTheHorizonAndBlackBelow) {
  for (const double turbidity : {2.0, 10.0})
    for (const double elevation : {0.0, 7.0, 90.0}) {
      const PaintedSky painted = paint(DaylightSky(turbidity, elevation));
      ASSERT_EQ(painted.parts.size(), 3u);
      for (const Spectrum& part : painted.parts)
        EXPECT_GE(*std::min_element(part.values.begin(), part.values.end()), 0);
      const SkyPicture& picture = painted.picture;
      const auto half =
          picture.values.begin() + static_cast<std::ptrdiff_t>(picture.values.size() / 2);
      EXPECT_TRUE(std::all_of(picture.values.begin(), half,
                              [](float value) { return value >= 0 && std::isfinite(value); }));
      EXPECT_TRUE(std::all_of(half, picture.values.end(), [](float value) { return value == 0; }));
      EXPECT_GT(painted_colour(painted, 0, picture.height / 2 - 1).luminance, 0);
    }
}

TEST(DaylightSky, AsAWholeIsBluerThanD65TheClearerItIs) {
  const auto x_of = [](double turbidity) {
    const Xyz xyz = emission_xyz(paint(DaylightSky(turbidity, 45)).whole, cie::observer_1931());
    return xyz[0] / (xyz[0] + xyz[1] + xyz[2]);
  };
  // S. T. Henderson, Daylight and its Spectrum (1977): clear skies of 10,000 K to 30,000 K and
  // more.
  EXPECT_LT(x_of(2), x_of(4));
  EXPECT_LT(x_of(4), x_of(10));
  EXPECT_GT(x_of(2), 0.24);
  EXPECT_LT(x_of(2), 0.2807);  // 10,000 K
  EXPECT_LT(x_of(10), 0.335);
}

std::string sky_light(const std::string& sky, const std::string& light = "") {
  return "light { name: 'sky' environment { sky { " + sky + " } } " + light + " } ";
}

TEST(DaylightSky, MakesTheGroundAsBrightAsItsLuminance) {
  for (const std::string sky : {"", "turbidity: 8 elevation: 10", "elevation: 90"}) {
    const auto xyz = test::render(
        "camera { eye { y: 10 } target {} up { z: -1 } vertical_fov: 1 } " +
        sky_light(sky, "luminance: 0.8") +
        "material { name: 'white' diffuse { constant: 1 } } object { name: 'floor' material: "
        "'white' plane {} } settings { width: 1 height: 1 spp: 64 light_samples: 16 }");
    EXPECT_NEAR(xyz.at(0, 0)[1], 0.8, 3e-3) << sky;
  }
}

TEST(DaylightSky, IsBrightestAboutTheSun) {
  // Seen at the sun's height, at −x (90° counterclockwise from −z), opposite, and along −z.
  const auto y = [](double x, double z) {
    return test::render("camera { eye {} target { y: 0.8 x: " + std::to_string(x) +
                        " z: " + std::to_string(z) + " } vertical_fov: 0.1 } " +
                        sky_light("elevation: 40 azimuth: 90") +
                        "material { name: 'm' } object { name: 'o' material: 'm' sphere { center { "
                        "y: -99 } radius: 1 } } settings { width: 1 height: 1 }")
        .at(0, 0)[1];
  };
  EXPECT_GT(y(-1, 0), 2 * y(0, -1));
  EXPECT_GT(y(0, -1), y(1, 0));
  EXPECT_NEAR(y(0, -1), y(0, 1), 1e-2F * y(0, 1));
}

TEST(DaylightSky, WhatIsNoSkyIsRefusedWhereItStands) {
  const auto field = [](const std::string& light) {
    const auto problems = validate_scene(test::parse_scene(
        "camera { eye { z: 3 } target {} } " + light +
        "material { name: 'm' } object { name: 'o' material: 'm' sphere { radius: 1 } }"));
    return problems.size() == 1 ? problems.front().field : std::to_string(problems.size());
  };
  EXPECT_EQ(field(sky_light("")), "0");
  EXPECT_EQ(field(sky_light("turbidity: 1")), "light[0].environment.sky.turbidity");
  EXPECT_EQ(field(sky_light("elevation: -1")), "light[0].environment.sky.elevation");
  EXPECT_EQ(field(sky_light("", "spectrum { standard: 'D65' }")), "light[0].spectrum");
  EXPECT_EQ(field("light { environment { file: 'a.exr' sky {} } }"), "light[0].environment.file");
  EXPECT_EQ(field("light { direction { y: -1 } spectrum { sunlight { turbidity: 11 } } }"),
            "light[0].spectrum.sunlight.turbidity");
  EXPECT_EQ(field("light { direction { y: -1 } spectrum { sunlight {} } }"), "0");
}

}  // namespace
}  // namespace metamer
