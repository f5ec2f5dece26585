#include "server/cpu/normal_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/server/cpu/soft/sky_file.h"
#include "tests/server/methods/methods.h"
#include "tests/server/scene/small_png.h"
#include "tests/server/test_scene.h"

namespace metamer {
namespace {

const std::string quad = "quad { corner { x: -1 y: -1 } u { x: 2 } v { y: 2 } }";

/// A white card across the view, lit from `light`, direction towards it.
std::string lit_card(const std::string& maps, const Eigen::Vector3d& light,
                     const std::string& shape = quad, const std::string& settings = "spp: 1") {
  const auto number = [](double value) { return std::to_string(-value); };
  return "camera { eye { z: 5 } target {} vertical_fov: 22.61986495 } "
         "light { name: 'l' direction { x: " +
         number(light.x()) + " y: " + number(light.y()) + " z: " + number(light.z()) +
         " } spectrum { standard: 'D65' } } material { name: 'card' diffuse { constant: 1 } " +
         maps + " } object { name: 'card' material: 'card' " + shape +
         " } settings { width: 16 height: 16 " + settings + " }";
}

/// The pixel of a normal map; a tilt of atan(3/4) towards `x` or `y` has 16 bits enough in 8.
std::string normal_pixel(double x, double y, double z) {
  const auto byte = [](double value) { return static_cast<char>(std::lround(128 + 127 * value)); };
  return {byte(x), byte(y), byte(z)};
}
const test::Files to_u{{"n.png", test::small_png(1, 1, 2, normal_pixel(0.6, 0, 0.8))}};
const test::Files to_v{{"n.png", test::small_png(1, 1, 2, normal_pixel(0, 0.6, 0.8))}};
const std::string normal_map = "normal_map { file: 'n.png' }";

/// Y in the middle, by the cosine of a card that faces the light.
double lit(const std::string& scene, const test::Files& files) {
  return double{test::render(scene, files).at(8, 8)[1]};
}

/// Of a normal as 8 bits have it.
double cosine(const Eigen::Vector3d& normal, const Eigen::Vector3d& light) {
  const auto stored = [](double value) { return std::round(127 * value) / 127; };
  return Eigen::Vector3d(stored(normal.x()), stored(normal.y()), stored(normal.z()))
      .normalized()
      .dot(light);
}

TEST(NormalMaps, ATiltedNormalIsATiltedPlaneByLambertsCosine) {
  const Eigen::Vector3d light = Eigen::Vector3d(0.3, -0.2, 1).normalized();
  EXPECT_NEAR(lit(lit_card(normal_map, light), to_u), cosine({0.6, 0, 0.8}, light), 2e-5);
  EXPECT_NEAR(lit(lit_card(normal_map, light), to_v), cosine({0, 0.6, 0.8}, light), 2e-5);
}

TEST(NormalMaps, AFlatMapChangesNothing) {
  const test::Files flat{{"n.png", test::small_png(1, 1, 2, {'\x80', '\x80', '\xFF'})}};
  const Eigen::Vector3d light = Eigen::Vector3d(0.5, 0.4, 0.3).normalized();
  EXPECT_NEAR(lit(lit_card(normal_map, light), flat), lit(lit_card("", light), {}), 1e-6);
}

TEST(NormalMaps, StrengthScalesTheSlope) {
  // Twice 3/4; and none at all.
  const Eigen::Vector3d light = Eigen::Vector3d(0.1, 0, 1).normalized();
  const auto at = [&](const std::string& strength) {
    return lit(lit_card("normal_map { file: 'n.png' strength: " + strength + " }", light), to_u);
  };
  EXPECT_NEAR(at("2"), Eigen::Vector3d(1.5, 0, 1).normalized().dot(light), 5e-3);
  EXPECT_NEAR(at("-1"), Eigen::Vector3d(-0.75, 0, 1).normalized().dot(light), 5e-3);
  EXPECT_NEAR(at("0"), light.z(), 1e-5);
}

TEST(NormalMaps, TangentsGoWithTurnedAndMirroredUvs) {
  // The card's u along world axes as its UVs have it: what tilts to u tilts along that axis.
  const Eigen::Vector3d light = Eigen::Vector3d(0.3, -0.2, 1).normalized();
  const struct {
    const char* uvs;  // at -1 -1, 1 -1, 1 1, -1 1
    Eigen::Vector3d u, v;
  } cases[] = {{"vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n", {1, 0, 0}, {0, 1, 0}},
               {"vt 1 0\nvt 0 0\nvt 0 1\nvt 1 1\n", {-1, 0, 0}, {0, 1, 0}},
               {"vt 0 0\nvt 0 1\nvt 1 1\nvt 1 0\n", {0, 1, 0}, {1, 0, 0}},
               {"vt 0 1\nvt 0 0\nvt 1 0\nvt 1 1\n", {0, 1, 0}, {-1, 0, 0}}};
  for (const auto& one : cases)
    for (const char* transform : {"", " transform { scale { x: -1 y: 1 z: 1 } }"}) {
      const double mirror = *transform ? -1 : 1;
      const Eigen::Vector3d m(mirror, 1, 1), up(0, 0, 1);
      for (const bool along_u : {true, false}) {
        test::Files files = along_u ? to_u : to_v;
        files["card.obj"] = std::string("v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n") + one.uvs +
                            "f 1/1 2/2 3/3 4/4\n";
        const Eigen::Vector3d along = (along_u ? one.u : one.v).cwiseProduct(m);
        EXPECT_NEAR(
            lit(lit_card(normal_map, light, std::string("mesh { file: 'card.obj' }") + transform),
                files),
            cosine(0.6 * along + 0.8 * up, light), 1e-4)
            << one.uvs << transform << along_u;
      }
    }
}

TEST(NormalMaps, APictureThatIsTurnedTurnsItsNormals) {
  // By a quarter from u towards v: the picture's u is the surface's v.
  const Eigen::Vector3d light = Eigen::Vector3d(0.3, -0.2, 1).normalized();
  EXPECT_NEAR(lit(lit_card("normal_map { file: 'n.png' rotation: 90 }", light), to_u),
              cosine(Eigen::Vector3d(0, -0.6, 0.8), light), 1e-4);
  EXPECT_NEAR(lit(lit_card("normal_map { file: 'n.png' scale { u: -3 v: 2 } }", light), to_u),
              cosine(Eigen::Vector3d(-0.6, 0, 0.8), light), 1e-4);
}

TEST(NormalMaps, FromBehindAHillIsAValley) {
  // The card's back is seen: its own normal is away from the eye.
  const Eigen::Vector3d light = Eigen::Vector3d(0.3, -0.2, 1).normalized();
  const std::string back = "quad { corner { x: 1 y: -1 } u { x: -2 } v { y: 2 } }";
  EXPECT_NEAR(lit(lit_card(normal_map, light, back), to_u), cosine({0.6, 0, 0.8}, light), 1e-4);
}

TEST(NormalMaps, OnASphereUIsEastAndVIsNorth) {
  const Eigen::Vector3d light = Eigen::Vector3d(0.3, -0.2, 1).normalized();
  // In the middle of the view, towards z: east is x.
  const std::string sphere = "sphere { radius: 0.9 }", tiny = "spp: 64";
  EXPECT_NEAR(lit(lit_card(normal_map, light, sphere, tiny), to_u), cosine({0.6, 0, 0.8}, light),
              0.08);
  EXPECT_NEAR(lit(lit_card(normal_map, light, sphere, tiny), to_v), cosine({0, 0.6, 0.8}, light),
              0.08);
}

TEST(NormalMaps, WhatLiesBelowTheSurfaceDoesNotShineThrough) {
  // Towards u the turned normal sees a light that is below the card.
  const Eigen::Vector3d below = Eigen::Vector3d(1, 0, -0.2).normalized();
  EXPECT_EQ(lit(lit_card(normal_map, below), to_u), 0);
}

TEST(NormalMaps, ANormalFromBelowIsBroughtAboveTheSurface) {
  const test::Files hostile{{"n.png", test::small_png(1, 1, 2, {'\xFF', '\x80', '\0'})}};
  const Eigen::Vector3d light = Eigen::Vector3d(1, 0, 0.1).normalized();
  const double y = lit(lit_card(normal_map, light), hostile);
  EXPECT_NEAR(y, Eigen::Vector3d(1, 0, 0.01).normalized().dot(light), 2e-3);
  // No direction at all, a pixel without any, is the surface's own.
  const test::Files nothing{{"n.png", test::small_png(1, 1, 2, {'\x80', '\x80', '\x80'})}};
  EXPECT_NEAR(lit(lit_card(normal_map, light), nothing), light.z(), 1e-3);
}

TEST(NormalMaps, ARampOfHeightsIsATiltedPlane) {
  // From 0 to 1.5 m over 2 m of u: a slope of 3/4. Its pixels' middles are 2/64 m apart.
  std::string ramp;
  for (int x = 0; x < 64; ++x) ramp += static_cast<char>(4 * x);
  const test::Files files{{"h.png", test::small_png(64, 1, 0, ramp)}};
  const Eigen::Vector3d light = Eigen::Vector3d(0.3, -0.2, 1).normalized();
  const double strength = 1.5 / 64 * 255 / 4;
  const std::string bump =
      "bump_map { file: 'h.png' wrap: CLAMP strength: " + std::to_string(strength);
  EXPECT_NEAR(lit(lit_card(bump + " }", light), files), Eigen::Vector3d(-0.6, 0, 0.8).dot(light),
              2e-4);
  // Turned, it rises along v; twice as often along u, twice as steep.
  EXPECT_NEAR(lit(lit_card(bump + " rotation: -90 }", light), files),
              Eigen::Vector3d(0, -0.6, 0.8).dot(light), 2e-4);
  EXPECT_NEAR(lit(lit_card(bump + " scale { u: 2 v: 1 } offset { u: -0.5 } }", light), files),
              Eigen::Vector3d(-1.5, 0, 1).normalized().dot(light), 1e-3);
}

TEST(NormalMaps, AWaveOfHeightsHasItsDerivative) {
  // h = 0.05 sin 2πu, u from 0 to 1 over 2 m.
  std::vector<std::vector<float>> pixels;
  constexpr int size = 512;
  for (int x = 0; x < size; ++x)
    pixels.push_back({static_cast<float>(std::sin(2 * std::numbers::pi * (x + 0.5) / size))});
  const test::Files files{{"h.exr", test::sky_file(size, 1, {"Y"}, pixels)}};
  const Eigen::Vector3d light = Eigen::Vector3d(0.6, 0, 0.8);
  const auto picture =
      test::render(lit_card("bump_map { file: 'h.exr' strength: 0.05 }", light), files);
  for (std::uint32_t x = 1; x < 15; ++x) {
    const double u = (x + 0.5) / 16,
                 slope = 0.05 * std::numbers::pi * std::cos(2 * std::numbers::pi * u);
    EXPECT_NEAR(double{picture.at(x, 8)[1]}, Eigen::Vector3d(-slope, 0, 1).normalized().dot(light),
                2e-3)
        << x;
  }
}

TEST(NormalMaps, AHeightIsInMetresHoweverLargeTheSceneIs) {
  std::string ramp;
  for (int x = 0; x < 64; ++x) ramp += static_cast<char>(4 * x);
  const test::Files files{{"h.png", test::small_png(64, 1, 0, ramp)}};
  const std::string far =
      "camera { eye { z: 5000 } target {} vertical_fov: 22.61986495 } light { name: 'l' direction "
      "{ x: -0.6 z: -0.8 } spectrum { standard: 'D65' } } material { name: 'card' diffuse { "
      "constant: 1 } bump_map { file: 'h.png' wrap: CLAMP strength: " +
      std::to_string(1500.0 / 64 * 255 / 4) +
      " } } object { name: 'card' material: 'card' quad { corner { x: -1000 y: -1000 } u { x: "
      "2000 } v { y: 2000 } } } settings { width: 16 height: 16 spp: 1 }";
  EXPECT_NEAR(lit(far, files), -0.6 * 0.6 + 0.8 * 0.8, 2e-4);
}

TEST(NormalMaps, MirrorsGoByTheTurnedNormal) {
  // Tilted by 30° about y, a mirror shows what is at its side.
  const std::string scene =
      "camera { eye { z: 5 } target {} vertical_fov: 10 } light { name: 'l' direction { x: 1 } "
      "spectrum { standard: 'D65' } } material { name: 'mirror' mirror: 1 diffuse { constant: 0 } "
      "normal_map { file: 'n.png' } } material { name: 'white' diffuse { constant: 1 } } "
      "object { name: 'm' material: 'mirror' " +
      quad +
      " } object { name: 'w' material: 'white' quad { corner { x: 3 y: -3 z: -3 } u { y: 6 } v { "
      "z: 6 } } } settings { width: 4 height: 4 spp: 1 depth: 1 }";
  const test::Files tilted{
      {"n.png", test::small_png(1, 1, 2, normal_pixel(0.5, 0, std::sqrt(0.75)))}},
      flat{{"n.png", test::small_png(1, 1, 2, normal_pixel(0, 0, 1))}};
  EXPECT_NEAR(test::render(scene, tilted).at(2, 2)[1], 1, 1e-4);
  EXPECT_EQ(test::render(scene, flat).at(2, 2)[1], 0);
}

TEST(NormalMaps, EveryMethodCarriesThem) {
  const Eigen::Vector3d light = Eigen::Vector3d(0.3, -0.2, 1).normalized();
  for (const v1::Method& method : test::all_methods())
    EXPECT_NEAR(
        lit(lit_card(normal_map, light, quad,
                     "spp: 2 method { " + method.ShortDebugString() + " }"),
            to_u) /
            lit(lit_card("", light, quad, "spp: 2 method { " + method.ShortDebugString() + " }"),
                {}),
        cosine({0.6, 0, 0.8}, light) / light.z(), 1e-4)
        << method.ShortDebugString();
}

TEST(NormalMaps, AnObjectOfOtherShadingIsShadedByPhongAndThatIsSaid) {
  const RenderScene scene =
      test::compile_text(lit_card(normal_map, {0, 0, 1}, quad, "spp: 1 shading: GOURAUD"), to_u);
  EXPECT_EQ(scene.objects[0].shading, v1::PHONG);
  ASSERT_EQ(scene.notices.size(), 1u);
  EXPECT_EQ(scene.notices[0].field, "object[0]");
}

TEST(NormalMaps, AMeshWithoutUvsIsAProblemOfItsObject) {
  test::Files files = to_u;
  files["card.obj"] = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\n";
  try {
    test::compile_text(lit_card(normal_map, {0, 0, 1}, "mesh { file: 'card.obj' }"), files);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "object[0]: its mesh has no UVs, which the normal map of \"card\" needs");
  }
}

}  // namespace
}  // namespace metamer
