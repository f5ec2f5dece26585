#include "server/cpu/tracer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/scene/settings.h"
#include "server/plan/plan.h"
#include "server/scene/camera_space.h"
#include "tests/server/test_scene.h"

namespace metamer {
namespace {

/// A shiny sphere and a mirror on a floor; two lights, one of them a direction.
std::string booth(const std::string& settings) {
  return R"(
  camera { eye { x: 0.4 y: 1.2 z: 4 } target { y: 0.5 } }
  light { name: "lamp" position { x: 1 y: 2.4 z: 1 } spectrum { standard: "F11" } luminance: 0.8 }
  light { name: "sky" direction { x: 1 y: -2 z: -1 } spectrum { standard: "D65" } luminance: 0.4 }
  material { name: "floor" diffuse { constant: 0.5 } }
  material {
    name: "red" diffuse { samples { wavelength: [400, 580, 620, 700] value: [0.05, 0.05, 0.6, 0.7] } }
    diffuseness: 0.7 specularness: 0.3 blinn_phong { shininess: 40 }
  }
  material { name: "chrome" diffuse { constant: 0.1 } mirror: 0.8 specular { constant: 0.9 } }
  object { name: "ground" material: "floor" quad { corner { x: -3 z: 3 } u { x: 6 } v { z: -6 } } }
  object { name: "ball" material: "red" sphere { center { x: -0.6 y: 0.5 } radius: 0.5 } }
  object { name: "egg" material: "chrome" sphere { radius: 0.5 }
           transform { scale { x: 1 y: 1.4 z: 1 } } transform { translate { x: 0.6 y: 0.7 } } }
  settings { )" +
         settings + " }";
}

TEST(Tracer, GivesTheSameBitsForEveryTileSize) {
  for (unsigned spp : {1u, 2u, 3u, 5u, 8u, 12u, 16u}) {
    const std::string settings = "width: 90 height: 70 spp: " + std::to_string(spp);
    const auto reference = test::render(booth(settings + " tile_size: 16"));
    for (const char* size : {"8", "24", "64", "256"})
      EXPECT_EQ(test::render(booth(settings + " tile_size: " + size)).xyz, reference.xyz)
          << spp << " samples, tiles of " << size;
  }
}

struct NoSink : PixelSink {
  void take(std::uint32_t, std::uint32_t, const Gather&) override {}
};

TEST(Tracer, CameraRaysFillTheirPacketsWhateverTheSamplesOfAPixel) {
  for (unsigned spp = 1; spp <= 20; ++spp) {
    const std::string text = booth("width: 32 height: 16 spp: " + std::to_string(spp));
    const RenderScene scene = to_camera_space(test::compile_text(text));
    const v1::Plan plan =
        make_plan(scene, with_defaults(test::parse_scene(text).settings()), {.threads = 1});
    const std::atomic<bool> never = false;
    std::atomic<std::uint64_t> work = 0;
    const auto geometry = cpu::EmbreeScene::build(scene, never);
    const cpu::Tracer tracer(scene, *geometry, plan);
    auto workspace = tracer.make_workspace();
    NoSink sink;
    tracer.render({0, 0, 32, 16}, sink, workspace, never, work);
    const RayCount camera = workspace.rays[RayKind::camera];
    EXPECT_EQ(camera.rays, 32u * 16 * spp);
    EXPECT_EQ(camera.rays, camera.packets * lane_count) << spp;
  }
}

TEST(Tracer, WritesEveryPixelFiniteAndNotNegative) {
  for (unsigned spp : {1u, 4u, 16u})
    for (float value : test::render(booth("width: 37 height: 23 spp: " + std::to_string(spp))).xyz)
      ASSERT_TRUE(std::isfinite(value) && value >= 0) << value;
}

/// A quad of a grey of 0.5 facing the camera and one light.
std::string card(const std::string& light, const std::string& more = "") {
  return "camera { eye { z: 5 } target {} vertical_fov: 10 } light { name: 'l' " + light +
         " spectrum { standard: 'D65' } } material { name: 'grey' diffuse { constant: 0.5 } } "
         "object { name: 'card' material: 'grey' quad { corner { x: -1 y: -1 } u { x: 2 } v { y: 2 "
         "} } } " +
         more +
         "settings { width: 9 height: 9 spp: 4 method { point { from: 380 to: 780 step: 5 } } }";
}

TEST(Tracer, ADirectionalLightObeysLambertsCosineLaw) {
  for (double degrees : {0.0, 30.0, 60.0, 85.0}) {
    const double a = degrees * std::numbers::pi / 180;
    const auto picture = test::render(card("direction { x: " + std::to_string(-std::sin(a)) +
                                           " z: " + std::to_string(-std::cos(a)) + " }"));
    EXPECT_NEAR(picture.at(4, 4)[1], 0.5 * std::cos(a), 2e-6) << degrees;
  }
}

TEST(Tracer, APointLightFallsWithTheSquareOfItsDistanceOnlyWhenAskedTo) {
  // The middle pixel is small, so that all of it faces the light squarely.
  const auto y = [](const std::string& light) { return test::render(card(light)).at(4, 4)[1]; };
  EXPECT_NEAR(y("position { z: 2 }"), 0.5, 1e-3);
  EXPECT_NEAR(y("position { z: 4 }"), 0.5, 1e-3);
  EXPECT_NEAR(y("position { z: 2 } reference_distance: 1"), 0.5 / 4, 1e-3);
  EXPECT_NEAR(y("position { z: 4 } reference_distance: 1"), 0.5 / 16, 1e-3);
}

TEST(Tracer, ALightOnTheSurfaceItselfMakesNoInfinity) {
  // The middle of the one pixel lies exactly at the origin, and its distance squared underflows.
  for (const char* place : {"0", "1e-22", "1e-19", "1e-10"}) {
    std::string scene = card(std::string("position { z: ") + place + " } reference_distance: 1");
    scene.replace(scene.find("settings"), std::string::npos,
                  "settings { width: 1 height: 1 spp: 1 }");
    for (float value : test::render(scene).xyz)
      ASSERT_TRUE(std::isfinite(value) && value >= 0) << place;
  }
}

TEST(Tracer, ALightInASurfaceIsNotHiddenByIt) {
  // A ceiling at the light's own height, seen to shine on the card in every direction.
  const std::string ceiling =
      "object { name: 'ceiling' material: 'grey' quad { corner { x: -9 y: -9 z: 2 } u { x: 18 } v "
      "{ y: 8 "
      "} } } object { name: 'other' material: 'grey' quad { corner { x: -9 y: 0.9 z: 2 } u { x: 18 "
      "} v { "
      "y: 9 } } } ";
  for (const char* y : {"-3", "-1.5", "1.2", "2.7"})
    for (std::uint32_t x = 0; x < 9; ++x)
      EXPECT_GT(
          test::render(card(std::string("position { z: 2 y: ") + y + " }", ceiling)).at(x, 4)[1],
          0.05)
          << y;
}

TEST(Tracer, APictureDependsNeitherOnThePlaceInTheWorldNorOnTheUnit) {
  // The booth again, moved by a million metres and then written in units 2^40 times as small.
  const auto placed = [](double scale, double offset) {
    const auto at = [&](const char* axis, double value) {
      return std::string(axis) + ": " + std::to_string(value * scale + offset) + " ";
    };
    const auto length = [&](const char* axis, double value) {
      return std::string(axis) + ": " + std::to_string(value * scale) + " ";
    };
    return test::render(
        "camera { eye { " + at("x", 0) + at("y", 1.25) + at("z", 4) + "} target { " + at("x", 0) +
        at("y", 0.5) + at("z", 0) + "} } light { name: 'l' position { " + at("x", 1) + at("y", 3) +
        at("z", 1) + "} spectrum { standard: 'E' } reference_distance: " +
        std::to_string(2.5 * scale) + " } material { name: 'm' diffuse { constant: 0.5 } } " +
        "object { name: 'floor' material: 'm' quad { corner { " + at("x", -3) + at("y", 0) +
        at("z", 3) + "} u { " + length("x", 6) + "} v { " + length("z", -6) + "} } } " +
        "object { name: 'ball' material: 'm' sphere { center { " + at("x", 0) + at("y", 0.5) +
        at("z", 0) + "} radius: " + std::to_string(0.5 * scale) +
        " } } settings { width: 48 height: 32 spp: 1 }");
  };
  const auto reference = placed(1, 0);
  for (const auto& other : {placed(1, 1048576), placed(1099511627776.0, 0)})
    for (std::size_t i = 0; i < reference.xyz.size(); ++i)
      ASSERT_NEAR(other.xyz[i], reference.xyz[i], 1e-5) << i / 3 % 48 << ", " << i / 3 / 48;
}

TEST(Tracer, ALightBehindTheCardGivesNothing) {
  EXPECT_EQ(test::render(card("position { z: -2 }")).at(4, 4)[1], 0);
  EXPECT_EQ(test::render(card("direction { z: 1 }")).at(4, 4)[1], 0);
}

TEST(Tracer, ShadowsAreHard) {
  // The edge of the picture lies 0.34 to 0.44 from its middle. A ball of radius 0.25 halfway to the
  // light hides 0.31 of the card from the eye and 0.52 from the light.
  const auto edge = [](const std::string& radius) {
    return test::render(
               card("position { z: 2 }",
                    "object { name: 'ball' material: 'grey' sphere { center { z: 1 } radius: " +
                        radius + " } } "))
        .at(0, 4)[1];
  };
  EXPECT_EQ(edge("0.25"), 0);
  EXPECT_GT(edge("0.05"), 0.4);
}

TEST(Tracer, TheRowsOfAPictureRunFromTheTop) {
  const auto picture = test::render(
      "camera { eye { z: 5 } target {} vertical_fov: 40 } light { name: 'l' direction { z: -1 } "
      "spectrum { standard: 'E' } } material { name: 'm' diffuse { constant: 1 } } object { name: "
      "'o' "
      "material: 'm' quad { corner { x: 0.2 y: 0.2 } u { x: 9 } v { y: 9 } } } settings { width: "
      "16 "
      "height: 16 spp: 1 }");
  EXPECT_GT(picture.at(15, 0)[1], 0.9);  // upper right
  EXPECT_EQ(picture.at(0, 0)[1], 0);
  EXPECT_EQ(picture.at(15, 15)[1], 0);
}

TEST(Tracer, AMirrorShowsWhatItFacesTimesItsWeightAndColour) {
  // Looking along −z into a mirror at z = 0 tilted by 45°: it shows the white card above.
  const std::string scene =
      "camera { eye { z: 5 } target {} vertical_fov: 5 } "
      "light { name: 'l' direction { x: 1 y: 1 } spectrum { standard: 'E' } } "
      "material { name: 'white' diffuse { constant: 0.8 } } "
      "material { name: 'mirror' diffuseness: 0 mirror: 0.5 specular { constant: 0.25 } } "
      "object { name: 'card' material: 'white' quad { corner { x: -9 y: 4 z: -9 } u { x: 18 } v { "
      "z: 18 "
      "} } } "
      "object { name: 'glass' material: 'mirror' quad { corner { x: -1 y: -1 z: 1 } u { x: 2 } v { "
      "y: 2 "
      "z: -2 } } } "
      "settings { width: 5 height: 5 spp: 1 depth: ";
  EXPECT_NEAR(test::render(scene + "4 }").at(2, 2)[1], 0.8 * std::sqrt(0.5) * 0.5 * 0.25, 1e-6);
  EXPECT_EQ(test::render(scene + "0 }").at(2, 2)[1], 0);
}

TEST(Tracer, ParallelMirrorsEndAtTheDepth) {
  // Between two facing mirrors with a grey of 0.5 of their own: Σ m^k, k = 0 … depth.
  const std::string scene =
      "camera { eye { z: 0.5 } target {} vertical_fov: 1 } "
      "light { name: 'l' position { z: 0.5 x: 0.001 } spectrum { standard: 'E' } } "
      "material { name: 'm' diffuse { constant: 0.5 } mirror: 0.5 specular { constant: 1 } } "
      "object { name: 'a' material: 'm' quad { corner { x: -9 y: -9 } u { x: 18 } v { y: 18 } } } "
      "object { name: 'b' material: 'm' quad { corner { x: -9 y: -9 z: 1 } u { x: 18 } v { y: 18 } "
      "} } "
      "settings { width: 1 height: 1 spp: 1 depth: ";
  double sum = 0;
  for (int depth = 0; depth < 8; ++depth) {
    sum += 0.5 * std::pow(0.5, depth);
    EXPECT_NEAR(test::render(scene + std::to_string(depth) + " }").at(0, 0)[1], sum, 1e-4);
  }
}

TEST(Tracer, AnInterpolatedNormalMakesAnEllipsoidSmooth) {
  // The egg of the booth against its implicit equation: brightness follows the analytic normal.
  const auto picture = test::render(
      "camera { eye { z: 50 } target {} vertical_fov: 3 } light { name: 'l' direction { x: -1 z: "
      "-1 } "
      "spectrum { standard: 'E' } } material { name: 'm' diffuse { constant: 1 } } object { name: "
      "'o' "
      "material: 'm' sphere { radius: 1 } transform { scale { x: 1 y: 0.5 z: 2 } } } settings { "
      "width: "
      "31 height: 31 spp: 1 }");
  const double pixel = 2 * std::tan(1.5 * std::numbers::pi / 180) / 31;
  for (int i = -5; i <= 5; ++i) {
    // The ray through this pixel, and where it meets x² + 4 y² + z²/4 = 1.
    const Eigen::Vector3d d = Eigen::Vector3d(pixel * i, 0, -1).normalized(), o(0, 0, 50);
    const Eigen::DiagonalMatrix<double, 3> q(1, 4, 0.25);
    const double a = d.dot(q * d), b = o.dot(q * d), c = o.dot(q * o) - 1;
    const Eigen::Vector3d p = o + d * ((-b - std::sqrt(b * b - a * c)) / a);
    const double n_dot_l = (q * p).normalized().dot(Eigen::Vector3d(1, 0, 1).normalized());
    EXPECT_NEAR(picture.at(static_cast<std::uint32_t>(15 + i), 15)[1], std::max(0.0, n_dot_l), 2e-4)
        << i;
  }
}

}  // namespace
}  // namespace metamer
