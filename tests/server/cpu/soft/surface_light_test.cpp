// Lights with a surface, against closed forms of what they send to a white, and where they are
// seen.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/server/test_scene.h"

namespace metamer {
namespace {

constexpr double pi = std::numbers::pi;
std::string text(double value) { return std::to_string(value); }

/// Y of the origin's neighbourhood, seen from above by one pixel of a white card at y = 0.
double white_under(const std::string& light, const std::string& more = "",
                   const std::string& settings = "spp: 16 light_samples: 64") {
  return double{test::render("camera { eye { y: 1.5 } target {} up { z: -1 } vertical_fov: 1e-4 } "
                             "light { name: 'l' spectrum { standard: 'D65' } visible: false " +
                             light +
                             " } material { name: 'white' diffuse { constant: 1 } } object { name: "
                             "'card' material: 'white' quad { corner { x: -9 z: 9 } u { x: 18 } v "
                             "{ z: -18 } } } " +
                             more + " settings { width: 1 height: 1 " + settings + " }")
                    .at(0, 0)[1]};
}

/// A horizontal quad a × b above the origin, at height c, that shines down.
std::string ceiling_light(double a, double b, double c) {
  return "quad { corner { x: " + text(-a / 2) + " y: " + text(c) + " z: " + text(-b / 2) +
         " } u { x: " + text(a) + " } v { z: " + text(b) + " } }";
}

/// Of a small horizontal face to a rectangle above it whose corner is over it: R. Siegel and
/// J. R. Howell, Thermal Radiation Heat Transfer (1992), configuration 3.
double corner_factor(double a, double b, double c) {
  const double x = a / c, y = b / c;
  return (x / std::hypot(1, x) * std::atan(y / std::hypot(1, x)) +
          y / std::hypot(1, y) * std::atan(x / std::hypot(1, y))) /
         (2 * pi);
}

TEST(QuadLight, SendsWhatTheConfigurationFactorSays) {
  for (const double c : {0.01, 0.3, 2.0, 20.0})
    for (const double b : {0.02, 1.0, 3.0}) {
      const double expected = 4 * corner_factor(0.5, b / 2, c);
      EXPECT_NEAR(white_under(ceiling_light(1, b, c)), expected, 2e-3 * expected) << b << " " << c;
    }
}

TEST(QuadLight, ThatLeansSendsLambertsSumOverItsEdges) {
  // A slanted parallelogram: the closed form for a polygon, edge by edge.
  const std::array<Eigen::Vector3d, 4> corners = {
      Eigen::Vector3d(0.2, 0.5, -0.4), {1.2, 0.9, -0.4}, {1.4, 1.3, 0.6}, {0.4, 0.9, 0.6}};
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d& from = corners[i];
    const Eigen::Vector3d& to = corners[(i + 1) % 4];
    sum += std::acos(from.normalized().dot(to.normalized())) * from.cross(to).normalized().y();
  }
  const double expected = std::abs(sum) / (2 * pi);
  EXPECT_NEAR(white_under("quad { corner { x: 0.2 y: 0.5 z: -0.4 } u { x: 1 y: 0.4 } v { x: 0.2 y: "
                          "0.4 z: 1 } }"),
              expected, 3e-3 * expected);
}

TEST(DiskLight, OnItsAxisSendsTheSquareOfTheSineOfItsHalfAngle) {
  for (const double height : {0.01, 0.5, 3.0, 100.0}) {
    const double expected = 0.25 / (0.25 + height * height);
    EXPECT_NEAR(
        white_under("disk { center { y: " + text(height) + " } normal { y: -3 } radius: 0.5 }"),
        expected, 5e-3 * expected)
        << height;
  }
}

TEST(SphereLight, SendsTheSquareOfRadiusByDistanceTimesTheCosine) {
  for (const double degrees : {0.0, 30.0, 60.0})
    for (const double distance : {0.6, 2.0, 1000.0}) {
      const double a = degrees * pi / 180, radius = 0.25;
      if (distance * std::cos(a) < radius) continue;  // part of it is below the horizon
      const double expected = std::pow(radius / distance, 2) * std::cos(a);
      EXPECT_NEAR(white_under("sphere { center { x: " + text(distance * std::sin(a)) +
                              " y: " + text(distance * std::cos(a)) + " } radius: 0.25 }"),
                  expected, 2e-3 * expected)
          << degrees << " " << distance;
    }
}

TEST(SurfaceLight, HasItsLuminanceAtItsReferenceDistance) {
  for (const std::string& light :
       {ceiling_light(1, 0.2, 0.7), ceiling_light(3, 3, 0.7),
        std::string("disk { center { y: 0.7 } normal { y: -1 } radius: 2 }"),
        std::string("sphere { center { y: 0.7 } radius: 0.4 }")})
    EXPECT_NEAR(white_under(light + " luminance: 0.6 reference_distance: 0.7"), 0.6, 3e-3) << light;
}

TEST(SurfaceLight, SmallLightAndSmallFaceMayChangePlaces) {
  // L A cos cos / (π d²) both ways: the light leans where the face lay flat, and the other way
  // round.
  const auto between = [](const std::string& up, const std::string& light_normal) {
    return double{
        test::render(
            "camera { eye { x: 6 y: 5 } target {} vertical_fov: 1e-4 } light { name: 'l' "
            "spectrum { standard: 'E' } visible: false disk { center { y: 2 } normal { " +
            light_normal +
            " } radius: 0.01 } luminance: 1e3 } material { name: 'white' diffuse { "
            "constant: 1 } } object { name: 'face' material: 'white' quad { corner { x: "
            "-0.01 z: 0.01 } u { x: 0.02 } v { z: -0.02 } } transform { rotate { axis { z: "
            "1 } degrees: " +
            up + " } } } settings { width: 1 height: 1 spp: 4 light_samples: 16 }")
            .at(0, 0)[1]};
  };
  const double lean = 40 * pi / 180;
  const double tilted_light =
      between("0", "x: " + text(std::sin(lean)) + " y: " + text(-std::cos(lean)));
  const double tilted_face = between("-40", "y: -1");
  const double expected = 1e3 * 1e-4 * std::cos(lean) / 4;
  EXPECT_NEAR(tilted_light, expected, 1e-3 * expected);
  EXPECT_NEAR(tilted_face, expected, 1e-3 * expected);
}

TEST(SurfaceLight, ThatTouchesTheSurfaceIsFinite) {
  for (const std::string light :
       {"quad { corner { x: -1 z: -1 } u { x: 2 } v { z: 2 } }",
        "quad { corner {} u { y: 1 } v { z: 1 } }", "disk { center {} normal { y: 1 } radius: 1 }",
        "disk { center {} normal { x: 1 } radius: 1 }", "sphere { center { y: 1 } radius: 1 }",
        "sphere { center {} radius: 1 }"}) {
    const double y = white_under(light);
    EXPECT_TRUE(y >= 0 && y <= 1.001) << light << " " << y;
  }
}

TEST(SurfaceLight, IsNotHiddenByTheCeilingThatItLiesIn) {
  const double alone = white_under(ceiling_light(1, 1, 2));
  EXPECT_NEAR(
      white_under(ceiling_light(1, 1, 2),
                  "object { name: 'ceiling' material: 'white' quad { corner { x: -9 y: 2 z: "
                  "9 } u { x: 18 } v { z: -18 } } } object { name: 'hatch' material: 'white' "
                  "sphere { center { y: 30 } radius: 1 } } "),
      alone, 1e-3);
}

TEST(SurfaceLight, CastsAPenumbraOfTheWidthOfSimilarTriangles) {
  // A half-plane at height 1 below a strip of width 0.4 at height 2: the penumbra goes from −0.2 to
  // 0.2, in whose middle half of the light is seen.
  const auto share = [](double x) {
    const std::string strip =
        "quad { corner { x: " + text(-0.2 - x) + " y: 2 z: -0.001 } u { x: 0.4 } v { z: 0.002 } }";
    const double open = white_under(strip);
    // The camera looks past the edge: it stands to its other side.
    return white_under(strip, "object { name: 'edge' material: 'white' quad { corner { x: " +
                                  text(1e-4 - x) + " y: 1 z: 9 } u { x: 5 } v { z: -18 } } } ") /
           open;
  };
  EXPECT_NEAR(share(-0.21), 1, 1e-3);
  EXPECT_NEAR(share(-0.1), 0.75, 0.02);
  EXPECT_NEAR(share(-0.01), 0.525, 0.02);
}

/// What one pixel sees that looks along −z from z = 5.
std::array<float, 3> seen(const std::string& light, const std::string& more = "") {
  return test::render(
             "camera { eye { z: 5 } target {} vertical_fov: 1 } light { name: 'l' spectrum "
             "{ standard: 'A' } luminance: 0.7 " +
             light +
             " } material { name: 'black' diffuse { constant: 0 } } material { name: "
             "'mirror' diffuse { constant: 0 } mirror: 0.5 } object { "
             "name: 'wall' material: 'black' quad { corner { x: -9 y: -9 z: -2 } u { x: 18 "
             "} v { y: 18 } } } " +
             more + " settings { width: 1 height: 1 spp: 4 }")
      .at(0, 0);
}

TEST(SurfaceLight, IsSeenWithItsLuminanceFromTheFrontAlone) {
  const std::string front = "quad { corner { x: -1 y: -1 } u { x: 2 } v { y: 2 } }";
  const std::string back = "quad { corner { x: -1 y: -1 } u { y: 2 } v { x: 2 } }";
  EXPECT_NEAR(seen(front)[1], 0.7, 1e-5);
  EXPECT_NEAR(seen(front)[0] / seen(front)[1], 1.0985, 1e-3);  // A's white, CIE 15
  EXPECT_NEAR(seen("disk { center {} normal { z: 1 } radius: 1 }")[1], 0.7, 1e-5);
  EXPECT_NEAR(seen("sphere { center {} radius: 1 }")[1], 0.7, 1e-5);
  EXPECT_EQ(seen(back)[1], 0);
  EXPECT_EQ(seen(front + " visible: false")[1], 0);
  EXPECT_EQ(seen("quad { corner { x: -1 y: -1 z: -3 } u { x: 2 } v { y: 2 } }")[1], 0);  // behind
}

TEST(SurfaceLight, IsSeenInAMirrorAlsoWhereTheEyeDoesNotSeeIt) {
  const std::string light = "quad { corner { x: -1 y: -1 z: 7 } u { y: 2 } v { x: 2 } }";
  const std::string mirror =
      "object { name: 'glass' material: 'mirror' quad { corner { x: -1 y: -1 z: -1 } u { x: 2 } v "
      "{ y: 2 } } } ";
  EXPECT_NEAR(seen(light, mirror)[1], 0.35, 1e-5);
  EXPECT_NEAR(seen(light + " visible: false", mirror)[1], 0.35, 1e-5);
}

/// A room with one of each, seen as a small picture.
std::string room(const std::string& settings) {
  return R"(
  camera { eye { z: 4 y: 1 } target { y: 0.7 } }
  light { name: "panel" quad { corner { x: -0.5 y: 2 z: -0.5 } u { x: 1 } v { z: 1 } }
          spectrum { standard: "F11" } luminance: 4 }
  light { name: "lamp" sphere { center { x: 1 y: 0.5 } radius: 0.1 } spectrum { standard: "A" } luminance: 9 }
  light { name: "spot" disk { center { x: -1 y: 1 z: 1 } normal { x: 1 y: -1 z: -1 } radius: 0.2 }
          spectrum { standard: "D65" } reference_distance: 1 }
  light { name: "sky" environment {} spectrum { standard: "D50" } luminance: 0.2 }
  material { name: "green" diffuse { samples { wavelength: [400, 540, 700] value: [0.1, 0.8, 0.1] } }
             diffuseness: 0.7 specularness: 0.3 blinn_phong { shininess: 40 } }
  material { name: "gold" fresnel { conductor { metal: "Au" } } mirror: 0.5 specularness: 0.5
             slope { beckmann { roughness: 0.3 } } cook_torrance {} }
  object { name: "floor" material: "green" plane {} }
  object { name: "ball" material: "gold" sphere { center { y: 0.6 } radius: 0.5 } }
  settings { width: 40 height: 30 )" +
         settings + " }";
}

TEST(SurfaceLight, ThePictureDoesNotDependOnItsTiles) {
  for (const std::string spp : {"1", "3", "8", "12"}) {
    const auto whole = test::render(room("tile_size: 64 spp: " + spp));
    EXPECT_EQ(test::render(room("tile_size: 8 spp: " + spp)).xyz, whole.xyz) << spp;
    for (const float value : whole.xyz) ASSERT_TRUE(std::isfinite(value) && value >= 0);
  }
}

TEST(SurfaceLight, EveryMethodCarriesIt) {
  const auto exact = test::render(room("method { exact {} }"));
  const std::map<std::string, double> methods = {{"point { step: 1 from: 360 to: 830 }", 2e-3},
                                                 {"linear { bases: 16 }", 2e-2},
                                                 {"prefilter {}", 0.3},
                                                 {"rgb {}", 0.5},
                                                 {"point { fitted: 24 }", 2e-2}};
  for (const auto& [method, tolerance] : methods) {
    const auto picture = test::render(room("method { " + method + " }"));
    for (std::size_t i = 1; i < exact.xyz.size(); i += 3)
      ASSERT_NEAR(picture.xyz[i], exact.xyz[i], tolerance * (exact.xyz[i] + 0.01F)) << method;
  }
}

}  // namespace
}  // namespace metamer
