// Objects that shine, against closed forms of what they send to a white, and where they are seen.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "common/scene/validate.h"
#include "server/scene/compile.h"
#include "tests/server/test_scene.h"

namespace metamer {
namespace {

std::string numbers(std::initializer_list<double> list) {
  std::string text;
  for (const double number : list) text += ' ' + std::to_string(number);
  return text;
}

/// One light: an object "lamp" of this shape.
std::string lamp(const std::string& shape, const std::string& light = "",
                 const std::string& material = "diffuse { constant: 0 }") {
  return "light { name: 'l' object: 'lamp' spectrum { standard: 'D65' } " + light +
         " } material { name: 'lamp' " + material + " } object { name: 'lamp' material: 'lamp' " +
         shape + " } ";
}

/// Y of the origin's neighbourhood, seen from the side by one pixel of a white card at y = 0.
double white_under_lamp(const std::string& lamps, const test::Files& files = {},
                        const std::string& settings = "spp: 64 light_samples: 64") {
  return double{
      test::render("camera { eye { x: 8.9 y: 1 } target {} vertical_fov: 1e-4 } " + lamps +
                       "material { name: 'white' diffuse { constant: 1 } } object { name: 'card' "
                       "material: 'white' quad { corner { x: -9 z: 9 } u { x: 18 } v { z: -18 } } "
                       "} settings { width: 1 height: 1 " +
                       settings + " }",
                   files)
          .at(0, 0)[1]};
}

/// A square of side 1 at height c, facing down, of n × n × 2 triangles.
std::string square_obj(int n, double c) {
  std::string text;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      text += "v" + numbers({double(i) / n - 0.5, c, double(j) / n - 0.5}) + "\n";
  const auto vertex = [n](int i, int j) { return ' ' + std::to_string(i * (n + 1) + j + 1); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      text += "f" + vertex(i, j) + vertex(i + 1, j) + vertex(i, j + 1) + "\n";
      text += "f" + vertex(i + 1, j + 1) + vertex(i, j + 1) + vertex(i + 1, j) + "\n";
    }
  return text;
}

/// A ball of radius 1 around the origin, corners counterclockwise seen from outside.
std::string ball_obj(int n) {
  std::string text;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      const double a = std::numbers::pi * i / n, b = std::numbers::pi * j / n;
      text +=
          "v" + numbers({std::sin(a) * std::sin(b), std::cos(a), std::sin(a) * std::cos(b)}) + "\n";
    }
  const auto vertex = [n](int i, int j) {
    return ' ' + std::to_string(i * 2 * n + j % (2 * n) + 1);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j)
      text += "f" + vertex(i, j) + vertex(i + 1, j) + vertex(i + 1, j + 1) + "\nf" + vertex(i, j) +
              vertex(i + 1, j + 1) + vertex(i, j + 1) + "\n";
  return text;
}

/// Of a small horizontal face to a square of side 1 over its middle: R. Siegel and J. R. Howell,
/// Thermal Radiation Heat Transfer (1992), configuration 3.
double square_factor(double height) {
  const double x = 0.5 / height, h = std::hypot(1, x);
  return 4 / std::numbers::pi * x / h * std::atan(x / h);
}

TEST(ObjectLight, SquareOfAnyTrianglesSendsWhatTheConfigurationFactorSays) {
  for (const double height : {0.2, 1.0, 5.0}) {
    const double expected = square_factor(height);
    const std::string quad = "quad { corner { x: -0.5 z: -0.5 y: " + std::to_string(height) +
                             " } u { x: 1 } v { z: 1 } }";
    EXPECT_NEAR(white_under_lamp(lamp(quad)), expected, 1e-3 * expected) << height;
    for (const int n : {1, 7})
      EXPECT_NEAR(white_under_lamp(lamp("mesh { file: 'square.obj' }"),
                                   {{"square.obj", square_obj(n, height)}}),
                  expected, 2e-3 * expected)
          << height << " " << n;
  }
}

TEST(ObjectLight, BallIsASphereLight) {
  // Radius 0.3, 2 m up: (r/d)² of its luminance.
  const double expected = 0.3 * 0.3 / 4;
  const std::string place =
      " transform { scale { x: 0.3 y: 0.3 z: 0.3 } } transform { translate { y: 2 } }";
  EXPECT_NEAR(white_under_lamp(lamp("sphere { radius: 1 }" + place)), expected, 1e-3 * expected);
  EXPECT_NEAR(
      white_under_lamp(lamp("mesh { file: 'ball.obj' }" + place), {{"ball.obj", ball_obj(96)}}),
      expected, 3e-3 * expected);
}

TEST(ObjectLight, EllipsoidOnItsAxisFillsTheConeOfItsTangents) {
  // Half-axes 0.2 across and b along the way, d away: sin² = a² / (d² − b² + a²).
  for (const double b : {0.05, 0.8, 1.9}) {
    const double a = 0.2, d = 2, expected = a * a / (d * d - b * b + a * a);
    EXPECT_NEAR(white_under_lamp(lamp("sphere { radius: 1 } transform { scale {" +
                                      std::string(" x: 0.2 z: -0.2 y: ") + std::to_string(b) +
                                      " } } transform { translate { y: 2 } }")),
                expected, 2e-3 * expected)
        << b;
  }
}

TEST(ObjectLight, TwoMeshesThatShareTheirTrianglesShineEachToItsOwnFront) {
  // One is mirrored to be below the other; both face the card.
  const test::Files files = {{"square.obj", square_obj(3, 0)}};
  const std::string mesh = "mesh { file: 'square.obj' } transform { translate { y: 1 } } ";
  const double one = white_under_lamp(lamp(mesh), files);
  const std::string other =
      "object { name: 'other' material: 'lamp' mesh { file: 'square.obj' } transform { translate { "
      "y: 7 } } } ";
  EXPECT_NEAR(white_under_lamp(lamp(mesh) + other, files), one, 2e-3 * one);  // an instance
  const std::string mirrored =
      "mesh { file: 'square.obj' } transform { scale { x: -1 y: 1 z: 1 } "
      "} transform { translate { y: 1 } } ";
  EXPECT_NEAR(white_under_lamp(lamp(mirrored), files), one, 2e-3 * one);
  EXPECT_NEAR(white_under_lamp(lamp(mirrored) + other, files), one, 2e-3 * one);
  const std::string turned =
      "mesh { file: 'square.obj' } transform { rotate { axis { x: 1 } "
      "degrees: 180 } } transform { translate { y: 1 } } ";
  EXPECT_EQ(white_under_lamp(lamp(turned), files), 0);
}

TEST(ObjectLight, CastsAShadowAndLightsWhatIsBehindNothing) {
  const std::string quad = "quad { corner { x: -0.5 z: -0.5 y: 2 } u { x: 1 } v { z: 1 } }";
  EXPECT_EQ(white_under_lamp(lamp(quad) +
                             "object { name: 'lid' material: 'lamp' quad { corner { x: -3 z: -3 y: "
                             "1 } u { x: 6 } v { z: 6 } } } "),
            0);
}

/// Y of the square, by its middle, seen from z = ± 3; its front is to +z.
double seen_lamp(double z, const std::string& light, const std::string& shape,
                 const std::string& more = "", const test::Files& files = {}) {
  return double{test::render("camera { eye { z: " + std::to_string(z) +
                                 " } target {} vertical_fov: 1 } " + lamp(shape, light) + more +
                                 "settings { width: 1 height: 1 }",
                             files)
                    .at(0, 0)[1]};
}

TEST(ObjectLight, IsSeenWithItsLuminanceFromTheFrontAlone) {
  const std::string quad = "quad { corner { x: -1 y: -1 } u { x: 2 } v { y: 2 } }";
  EXPECT_NEAR(seen_lamp(3, "luminance: 0.7", quad), 0.7, 1e-5);
  EXPECT_EQ(seen_lamp(-3, "luminance: 0.7", quad), 0);
  EXPECT_EQ(seen_lamp(3, "luminance: 0.7 visible: false", quad), 0);
  const test::Files files = {{"square.obj", square_obj(2, 0)}};
  for (const std::string x : {"1", "-1"})
    for (const std::string& more :
         {std::string(), std::string("object { name: 'other' material: 'lamp' mesh { file: "
                                     "'square.obj' } transform { translate { y: 99 } } } ")}) {
      const std::string mesh = "mesh { file: 'square.obj' } transform { scale { x: " + x +
                               " y: 1 z: 1 } } transform { rotate { axis { x: 1 } degrees: -90 } "
                               "}";
      EXPECT_NEAR(seen_lamp(3, "", mesh, more, files), 1, 1e-5) << x << more;
      EXPECT_EQ(seen_lamp(-3, "", mesh, more, files), 0) << x << more;
    }
  // A mirror behind the eye shows it whether the eye sees it or not.
  const std::string mirror =
      "material { name: 'mirror' mirror: 1 diffuse { constant: 0 } } "
      "object { name: 'm' material: 'mirror' quad { corner { x: -9 y: -9 z: "
      "5 } u { x: 18 } v { y: 18 } } } ";
  const auto in_mirror = [&](const std::string& light) {
    return test::render("camera { eye { z: 3 } target { z: 5 } vertical_fov: 1 } " +
                        lamp(quad, light) + mirror + "settings { width: 1 height: 1 }")
        .at(0, 0)[1];
  };
  EXPECT_NEAR(in_mirror(""), 1, 1e-5);
  EXPECT_NEAR(in_mirror("visible: false"), 1, 1e-5);
}

TEST(ObjectLight, ReflectsByItsMaterialToo) {
  // A directional light along its normal: a white of 0.4 under E = π, beside what shines itself.
  const std::string lamps = lamp("quad { corner { x: -1 y: -1 } u { x: 2 } v { y: 2 } }",
                                 "luminance: 0.5", "diffuse { constant: 0.4 }");
  const double y =
      double{test::render("camera { eye { z: 3 } target {} vertical_fov: 1 } " + lamps +
                          "light { name: 'sun' direction { z: -1 } spectrum { "
                          "standard: 'D65' } } settings { width: 1 height: 1 }")
                 .at(0, 0)[1]};
  EXPECT_NEAR(y, 0.9, 1e-4);
}

TEST(ObjectLight, CountsOnceWhereLightIsReflectedBetweenSurfaces) {
  // What the card reflects comes back from a black lamp alone: nothing is added.
  const std::string quad = "quad { corner { x: -0.5 z: -0.5 y: 1 } u { x: 1 } v { z: 1 } }";
  EXPECT_NEAR(white_under_lamp(lamp(quad), {}, "spp: 16 light_samples: 16 bounces: 2"),
              square_factor(1), 3e-3);
}

TEST(ObjectLight, IsSeenThroughGlassThatTouchesIt) {
  const std::string scene =
      "camera { eye { z: 3 } target {} vertical_fov: 1 } " +
      lamp("quad { corner { x: -1 y: -1 } u { x: 2 } v { y: 2 } }") +
      "material { name: 'clear' fresnel { dielectric { n { constant: 1 } } } transmission { "
      "transmittance { constant: 0.5 } thickness: 1 } } object { name: 'ball' material: 'clear' "
      "sphere { center { z: 1 } radius: 1 } } settings { width: 1 height: 1 }";
  EXPECT_NEAR(test::render(scene).at(0, 0)[1], 0.25, 1e-3);
}

TEST(ObjectLight, EveryMethodCarriesIt) {
  const auto with = [](const std::string& method) {
    return test::render("camera { eye { z: 4 y: 1 } target {} } " +
                        lamp("sphere { center { x: 2 y: 2 } radius: 0.5 }") +
                        "material { name: 'm' diffuse { samples { wavelength: [400, 540, 700] "
                        "value: [0.1, 0.8, 0.1] } } } object { name: 'o' material: 'm' sphere { "
                        "radius: 1 } } settings { width: 8 height: 8 method { " +
                        method + " } }");
  };
  const auto exact = with("exact {}");
  const std::map<std::string, float> methods = {{"point { step: 1 from: 360 to: 830 }", 2e-3F},
                                                {"linear { bases: 16 }", 1e-2F},
                                                {"prefilter {}", 0.3F},
                                                {"rgb {}", 0.3F},
                                                {"point { fitted: 24 }", 1e-2F}};
  for (const auto& [method, tolerance] : methods) {
    const auto other = with(method);
    for (std::size_t i = 1; i < exact.xyz.size(); i += 3)
      ASSERT_NEAR(other.xyz[i], exact.xyz[i], tolerance * exact.xyz[i]) << method;
  }
}

std::vector<std::string> refused_lamp(const std::string& text) {
  std::vector<std::string> all;
  for (const Problem& problem :
       validate_scene(test::parse_scene("camera { eye { z: 3 } target {} } " + text)))
    all.push_back(problem.field + ": " + problem.message);
  return all;
}

TEST(ObjectLight, WhatCantShineIsRefusedWhereItStands) {
  using Found = std::vector<std::string>;
  const std::string ball = "sphere { radius: 1 }";
  EXPECT_EQ(refused_lamp(lamp(ball)), Found());
  EXPECT_EQ(refused_lamp(lamp("plane {}")),
            Found{"light[0].object: a plane has no end: it can't shine"});
  EXPECT_EQ(refused_lamp(
                lamp(ball, "", "fresnel { dielectric { n { constant: 1.5 } } } transmission {}")),
            Found{"light[0].object: its material is clear: what lets light through can't shine"});
  EXPECT_EQ(refused_lamp(lamp(ball, "", "alpha { file: 'a.png' }")),
            Found{"light[0].object: its material has alpha: what is not all there can't shine"});
  EXPECT_EQ(refused_lamp(lamp(ball, "reference_distance: 2")),
            Found{"light[0].reference_distance: reference_distance is for lights whose shape is "
                  "known: the luminance is that of the object's own surface"});
  EXPECT_EQ(refused_lamp(lamp(ball) + "light { name: 'again' object: 'lamp' spectrum { standard: "
                                      "'A' } } light { object: 'lamb' spectrum { standard: 'A' } }")
                .size(),
            2u);
  EXPECT_THROW(
      test::compile_text("camera { eye { z: 3 } target {} } " + lamp("mesh { file: 'flat.obj' }"),
                         {{"flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"}}),
      std::invalid_argument);
}

}  // namespace
}  // namespace metamer
