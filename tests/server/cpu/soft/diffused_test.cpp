// Light that surfaces reflect to each other.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "common/color/lab.h"
#include "tests/server/cpu/soft/box_radiosity.h"
#include "tests/server/methods/methods.h"
#include "tests/server/scene/small_png.h"
#include "tests/server/test_scene.h"

namespace metamer {
namespace {

/// Within a ball with a lamp in its middle: each point of it receives the same from all others.
std::string lit_ball(const std::string& material, const std::string& settings) {
  return "camera { eye { z: 0.2 } target { x: 1 } vertical_fov: 1 } "
         "light { name: 'l' position {} spectrum { standard: 'D65' } } "
         "material { name: 'm' " +
         material +
         " } object { name: 'ball' material: 'm' sphere { radius: 1 } } "
         "settings { width: 1 height: 1 " +
         settings + " }";
}

float brightness(const std::string& scene, const test::Files& files = {}) {
  return test::render(scene, files).at(0, 0)[1];
}

/// a + a² + …, with n + 1 terms.
double series(double a, int n) { return a * (1 - std::pow(a, n + 1)) / (1 - a); }

TEST(InterReflection, AFurnaceIsBrighterByTheGeometricSeries) {
  for (const double a : {0.0, 0.2, 0.5, 0.9})
    for (const int bounces : {0, 1, 2, 5, 16})
      EXPECT_NEAR(brightness(lit_ball("diffuse { constant: " + std::to_string(a) + " }",
                                      "bounce_samples: 1 bounces: " + std::to_string(bounces))),
                  series(a, bounces), 2e-5 * series(a, bounces))
          << a << " " << bounces;
}

TEST(InterReflection, IsOfTheDiffusePartOfAModel) {
  // Half of the light is diffuse; mirrors and highlights throw nothing on surfaces.
  EXPECT_NEAR(brightness(lit_ball("diffuse { constant: 0.8 } diffuseness: 0.5 specularness: 0.5 "
                                  "blinn_phong { shininess: 1e6 }",
                                  "bounces: 3")),
              series(0.4, 3), 1e-4);
  // Oren and Nayar's, seen at a slant of tan 0.2 and lit from all around: A + B tan θ · 2/(3π), but
  // for what is lit from less than that.
  const std::string rough = "diffuse { constant: 0.5 } oren_nayar { roughness: 0.5 }";
  const double a = 1 - 0.5 * 0.25 / (0.25 + 0.33), b = 0.45 * 0.25 / (0.25 + 0.09);
  EXPECT_NEAR(
      brightness(lit_ball(rough, "spp: 64 bounces: 1")) / brightness(lit_ball(rough, "bounces: 0")),
      1 + 0.5 * (a + b * 0.2 * 2 / (3 * std::numbers::pi)), 1e-3);
  // A surface whose own light comes from all around already looks for it instead.
  EXPECT_NEAR(
      brightness(lit_ball("diffuse { constant: 0.5 } phong { ambient: 0.2 }", "bounces: 1")),
      0.5 + 0.4 * 0.5, 1e-4);
}

TEST(InterReflection, AHighlightThrowsNothingHoweverItsSurfaceIsShaded) {
  // A matte wall beside a glossy one without a diffuse part, whose highlight shines on it.
  const auto wall = [](const std::string& shading) {
    return brightness(
        "camera { eye { x: 1 y: 1 z: 0.2 } target { y: 0.5 z: 0.5 } vertical_fov: 1 } "
        "light { name: 'l' direction { y: -1 } spectrum { standard: 'D65' } } "
        "material { name: 'wall' diffuse { constant: 0.5 } } "
        "material { name: 'gloss' diffuseness: 0 specularness: 1 fresnel { conductor { metal: 'Cu' "
        "} } slope { beckmann { roughness: 0.5 } } cook_torrance {} } "
        "object { name: 'wall' material: 'wall' quad { corner {} u { y: 1 } v { z: 1 } } } "
        "object { name: 'floor' material: 'gloss' quad { corner {} u { z: 1 } v { x: 1 } } } "
        "settings { width: 1 height: 1 spp: 16 bounces: 2 shading: " +
        shading + " }");
  };
  for (const char* shading : {"PHONG", "CONSTANT", "GOURAUD", "QUADRATIC"})
    EXPECT_EQ(wall(shading), 0) << shading;
}

TEST(InterReflection, PathsThatSplitStayFewAndLoseNoLight) {
  // Each surface scatters and mirrors: with n bounces and m mirrors left there come a (1 + what is
  // left of n) + .4 (what is left of m) from it. There are 12,870 ways to take all 16.
  const double a = 0.3, mirror = 0.4;
  const std::function<double(int, int)> series = [&](int n, int m) -> double {
    return a + (n > 0 ? a * series(n - 1, m) : 0) + (m > 0 ? mirror * series(n, m - 1) : 0);
  };
  const auto picture = test::render(lit_ball("diffuse { constant: 0.3 } mirror: 0.4",
                                             "bounces: 8 depth: 8 spp: 256 bounce_samples: 4"));
  EXPECT_NEAR(picture.at(0, 0)[1] / series(8, 8), 1, 0.01);
  EXPECT_LT(picture.rays, 256u * 12870);
}

TEST(InterReflection, WhatIsFittedKnowsLightThatWasReflectedOften) {
  const std::string red =
      "diffuse { samples { wavelength: [400, 560, 600, 700] value: [0.05, 0.05, 0.9, 0.95] } "
      "interpolation: LINEAR }";
  const auto y = [&](const std::string& method) {
    return brightness(lit_ball(red, "bounces: 16 method { " + method + " }"));
  };
  const float truth = y("exact {}");
  EXPECT_NEAR(y("point { fitted: 8 }") / truth, 1, 0.05);
  EXPECT_NEAR(y("linear { bases: 8 }") / truth, 1, 0.05);
}

TEST(InterReflection, ATextureReflectsByItsShares) {
  const test::Files files{{"print.png", test::small_png(1, 1, 0, {'\x66'})}};  // 0.4
  const std::string print =
      "diffuse { constant: 0.2 } texture { file: 'print.png' spectrum { constant: 0.7 } }";
  EXPECT_NEAR(brightness(lit_ball(print, "bounces: 4 spp: 256 bounce_samples: 16"), files),
              series(0.4, 4), 4e-3);
}

TEST(InterReflection, GoesThroughWhatIsClear) {
  const std::string shell =
      "material { name: 'air' transmission {} fresnel { dielectric { n { constant: 1 } } } } "
      "object { name: 'shell' material: 'air' sphere { radius: 0.5 } } ";
  EXPECT_NEAR(brightness(shell + lit_ball("diffuse { constant: 0.5 }", "bounces: 3")),
              series(0.5, 3), 1e-4);
}

TEST(InterReflection, IsSeenInMirrors) {
  // A mirror between the eye and the wall, through which the lamp does not see.
  const std::string mirror =
      "material { name: 'mirror' mirror: 0.5 diffuse { constant: 0 } } object { name: 'mirror' "
      "material: 'mirror' quad { corner { x: 0.3 y: -0.1 z: 0.1 } u { y: 0.2 } v { z: 0.2 } } } ";
  const float seen = brightness(
      mirror + lit_ball("diffuse { constant: 0.5 }", "spp: 64 bounce_samples: 16 bounces: 3"));
  const float there = brightness(lit_ball("diffuse { constant: 0.5 }", "bounces: 3"));
  // Where the mirror stands itself, the wall is a little less lit.
  EXPECT_NEAR(seen / there, 0.5, 0.01);
}

TEST(InterReflection, EveryMethodCarriesIt) {
  // A red that gets deeper with each reflection, and a wall that looks so by itself.
  const auto wall = [](int bounces) {
    std::string nm, values;
    for (int i = 360; i <= 830; ++i) {
      const double a = 0.1 + 0.4 / (1 + std::exp(-(i - 590) / 25.0));
      nm += (i > 360 ? "," : "") + std::to_string(i);
      values += (i > 360 ? "," : "") + std::to_string(series(a, bounces));
    }
    return "diffuse { samples { wavelength: [" + nm + "] value: [" + values +
           "] } interpolation: LINEAR }";
  };
  const auto lab = [](const std::array<float, 3>& c) {
    return to_lab({c[0], c[1], c[2]}, {0.9505, 1, 1.089});
  };
  for (const v1::Method& method : test::all_methods()) {
    const std::string by = " method { " + method.ShortDebugString() + " }";
    const auto reflected = test::render(lit_ball(wall(0), "bounces: 2" + by)).at(0, 0),
               own = test::render(lit_ball(wall(2), "bounces: 0" + by)).at(0, 0);
    // Those made for a scene know one reflection in one, three in the other.
    const bool made_for_scene = method.has_linear() || method.point().fitted() > 0;
    EXPECT_LT(delta_e_00(lab(reflected), lab(own)), method.has_exact()                      ? 0.02
                                                    : method.has_point() && !made_for_scene ? 0.02
                                                                                            : 12)
        << method.ShortDebugString();
  }
}

/// A box of 1 m, whose walls are of different greys, with a lamp in its ceiling.
TEST(InterReflection, AClosedBoxIsAsBrightAsItsRadiosity) {
  const std::array<double, 6> albedo = {0.7, 0.3, 0.5, 0.6, 0.2, 0.4};
  const test::BoxRadiosity box(albedo, 10);
  const std::string head =
      "light { name: 'lamp' quad { corner { x: 0.4 y: 0.9999 z: 0.4 } u { x: 0.2 } v { z: 0.2 } } "
      "spectrum { standard: 'D65' } luminance: 10 } ";
  std::string walls;
  const char* sides[] = {
      "corner {} u { y: 1 } v { z: 1 }", "corner { x: 1 } u { y: 1 } v { z: 1 }",
      "corner {} u { x: 1 } v { z: 1 }", "corner { y: 1 } u { x: 1 } v { z: 1 }",
      "corner {} u { x: 1 } v { y: 1 }", "corner { z: 1 } u { x: 1 } v { y: 1 }"};
  for (int i = 0; i < 6; ++i) {
    const std::string name = "'" + std::to_string(i) + "'";
    walls += "material { name: " + name + " diffuse { constant: " + std::to_string(albedo[i]) +
             " } } object { name: " + name + " material: " + name + " quad { " + sides[i] + " } } ";
  }
  for (const auto& [x, y, z] : {std::array{0.5, 0.0, 0.5},
                                {0.0, 0.5, 0.5},
                                {0.25, 0.3, 1.0},
                                {1.0, 0.75, 0.6},
                                {0.2, 1.0, 0.3}}) {
    const auto place = [](double px, double py, double pz) {
      return " { x: " + std::to_string(px) + " y: " + std::to_string(py) +
             " z: " + std::to_string(pz) + " } ";
    };
    const float seen = brightness(
        "camera { eye" + place(0.45, 0.55, 0.5) + "target" + place(x, y, z) +
        "up { x: 0.3 y: 1 z: 0.2 } vertical_fov: 0.01 } " + head + walls +
        "settings { width: 1 height: 1 spp: 256 bounces: 12 bounce_samples: 8 light_samples: 4 }");
    EXPECT_NEAR(seen / box.at({x, y, z}), 1, 0.01) << x << " " << y << " " << z;
  }
}

}  // namespace
}  // namespace metamer
