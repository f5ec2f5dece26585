// Lights as the tracer sees them; their closed forms by themselves: tests/laws/lights_test.cpp.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/server/test_scene.h"

namespace metamer {
namespace {

/// Y of the middle of a card of 2 × 2 under a light, seen by one ray.
float middle(const std::string& light, const std::string& more = "") {
  return test::render("camera { eye { z: 10 } target {} vertical_fov: 1 } light { name: 'l' " +
                      light +
                      " spectrum { standard: 'E' } } material { name: 'm' diffuse { constant: 0.5 "
                      "} } object { name: 'o' material: 'm' " +
                      more +
                      " quad { corner { x: -1 y: -1 } u { x: 2 } v { y: 2 } } } settings { width: "
                      "1 height: 1 spp: 1 }")
      .at(0, 0)[1];
}

TEST(SpotLight, OnItsAxisItHasTheLuminanceOfAPointLightBitForBit) {
  for (const std::string z : {"0.01", "0.3", "2", "1e6"})
    for (const std::string reference : {"", "reference_distance: 1e-3", "reference_distance: 5"}) {
      const std::string position = "position { z: " + z + " }";
      const float expected = middle(position + reference);
      EXPECT_GT(expected, 0);
      for (const std::string cone :
           {"", "half_angle: 0.1", "half_angle: 90 penumbra: 1", "half_angle: 0.1 penumbra: 0"})
        EXPECT_EQ(middle("spot { " + position + " direction { z: -7 } " + cone + " } " + reference),
                  expected)
            << z << " " << reference << " " << cone;
    }
}

/// A spot above the card's middle whose axis leans so many degrees.
std::string leaning(double degrees, const std::string& cone) {
  const double a = degrees * std::numbers::pi / 180;
  return "spot { position { z: 2 } direction { x: " + std::to_string(std::sin(a)) +
         " z: " + std::to_string(-std::cos(a)) + " } " + cone + " }";
}

TEST(SpotLight, FadesAsItTurnsAway) {
  const float full = middle("position { z: 2 }");
  const std::string cone = "half_angle: 40 penumbra: 0.5";
  const double outer = std::cos(40 * std::numbers::pi / 180), inner = (1 + outer) / 2;
  for (double lean = 0; lean < 60; lean += 2.5) {
    const double cosine = std::cos(lean * std::numbers::pi / 180);
    const double t = std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0);
    EXPECT_NEAR(middle(leaning(lean, cone)) / full, t * t * (3 - 2 * t), 1e-4) << lean;
  }
  EXPECT_EQ(middle(leaning(41, cone)), 0);
  EXPECT_EQ(middle(leaning(180, cone)), 0);
}

TEST(SpotLight, GouraudInterpolatesWhatTheCornersGetOfIt) {
  // The middle of the card lies between two of its corners, 35.3° off the axis.
  const double cosine = 2 / std::sqrt(6.0), outer = std::cos(60 * std::numbers::pi / 180);
  const double t = (cosine - outer) / (1 - outer);
  EXPECT_NEAR(middle("spot { position { z: 2 } direction { z: -1 } half_angle: 60 penumbra: 1 }",
                     "shading: GOURAUD"),
              0.5 * cosine * t * t * (3 - 2 * t), 1e-5);
}

TEST(SpotLight, OnTheSurfaceItselfItMakesNoInfinity) {
  for (const std::string z : {"0", "1e-22", "1e-19", "1e-10"})
    for (const std::string reference : {"", "reference_distance: 1"}) {
      const float y = middle("spot { position { z: " + z + " } direction { z: -1 } } " + reference);
      EXPECT_TRUE(std::isfinite(y) && y >= 0) << z << " " << reference;
    }
}

}  // namespace
}  // namespace metamer
