// A lens: circles of confusion, what is sharp, and what it leaves alone.

#include <gtest/gtest.h>

#include <cmath>

#include "common/scene/settings.h"
#include "common/scene/validate.h"
#include "server/plan/features.h"
#include "tests/server/test_scene.h"

namespace metamer {
namespace {

/// From z = 0 along −z; a picture 0.2 wide at distance 1.
std::string view_of(const std::string& lens, const std::string& scene,
                    const std::string& settings) {
  return "camera { eye {} target { z: -2 } vertical_fov: 11.4211863 " + lens + " } " + scene +
         " settings { width: 40 height: 40 " + settings + " }";
}

std::string point_of_light(double z) {
  return "light { name: 'spot' sphere { center { z: " + std::to_string(-z) +
         " } radius: " + std::to_string(0.005 * z) +
         " } spectrum { standard: 'E' } luminance: 100 } material { name: 'm' } "
         "object { name: 'far' material: 'm' sphere { center { z: 9 } radius: 1 } }";
}

/// Of a disk that is alike everywhere, by its second moment, as a share of the picture's width.
double diameter(const test::Rendered& picture) {
  double sum = 0, moment = 0;
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x) {
      const double value = double{picture.at(x, y)[1]}, dx = x + 0.5 - picture.width / 2.0,
                   dy = y + 0.5 - picture.height / 2.0;
      sum += value;
      moment += value * (dx * dx + dy * dy);
    }
  return 2 * std::sqrt(2 * moment / sum) / picture.width;
}

TEST(Lens, BlursAPointToTheCircleOfConfusion) {
  // Of a point z away, with f in focus: the cone through the lens is 2 R |z − f| / z wide there.
  const double radius = 0.1, focus = 2;
  for (const double z : {1.4, 4.0, 8.0}) {
    const double point = 2 * radius * std::abs(z - focus) / z / (0.2 * focus);
    const double expected = std::hypot(point, 0.01 / 0.2);  // second moments add up
    const auto picture =
        test::render(view_of("aperture_radius: 0.1", point_of_light(z), "spp: 256"));
    EXPECT_NEAR(diameter(picture), expected, 0.03 * expected) << z;
  }
}

const std::string edge =
    "light { name: 'l' direction { z: -1 } spectrum { standard: 'E' } } material { name: 'white' "
    "diffuse { constant: 0.8 } } object { name: 'card' material: 'white' quad { corner { x: -0.07 "
    "y: -0.1 z: -2 } u { x: 0.11 y: 0.03 } v { x: -0.04 y: 0.17 } } }";

TEST(Lens, IsSharpAtTheDistanceOfItsTarget) {
  const auto pinhole = test::render(view_of("", edge, "spp: 16"));
  for (const std::string lens :
       {"aperture_radius: 0.3", "aperture_radius: 0.3 focus_distance: 2"}) {
    const auto focused = test::render(view_of(lens, edge, "spp: 16"));
    double apart = 0;
    for (std::size_t i = 1; i < pinhole.xyz.size(); i += 3)
      apart += double{std::abs(focused.xyz[i] - pinhole.xyz[i])};
    EXPECT_LT(apart, 0.5) << lens;  // of about 350 white pixels
  }
  const auto blurred =
      test::render(view_of("aperture_radius: 0.3 focus_distance: 1", edge, "spp: 16"));
  EXPECT_LT(blurred.at(20, 20)[1], 0.5F);
}

TEST(Lens, WithoutAnApertureIsNone) {
  const auto pinhole = test::render(view_of("", edge, "spp: 4"));
  EXPECT_EQ(test::render(view_of("aperture_radius: 0 focus_distance: 1", edge, "spp: 4")).xyz,
            pinhole.xyz);
}

TEST(Lens, GivesTheSameBitsWhateverTheTilesAre) {
  const std::string scene =
      "light { name: 'lamp' object: 'lamp' spectrum { standard: 'E' } } material { name: 'm' "
      "diffuse { constant: 0.8 } } object { name: 'lamp' material: 'm' sphere { center { x: 0.05 "
      "y: "
      "0.1 z: -1.5 } radius: 0.04 } } object { name: 'floor' material: 'm' plane { point { y: -0.1 "
      "} } }";
  EXPECT_EQ(test::render(view_of("aperture_radius: 0.1", scene, "spp: 2 tile_size: 8")).xyz,
            test::render(view_of("aperture_radius: 0.1", scene, "spp: 2 tile_size: 40")).xyz);
}

TEST(Lens, IsAFeatureOfTheCamera) {
  const std::string scene = view_of("aperture_radius: 0.1", edge, "");
  const auto needs =
      features_of(test::compile_text(scene), with_defaults(test::parse_scene(scene).settings()));
  ASSERT_EQ(needs.size(), 1u);
  EXPECT_EQ(needs[0].feature, Feature::lens);
  EXPECT_EQ(needs[0].field, "camera.aperture_radius");
}

TEST(Lens, NumbersThatAreNoLensAreRefusedWhereTheyStand) {
  const auto field = [](const std::string& lens) {
    const auto problems = validate_scene(test::parse_scene(view_of(lens, edge, "")));
    return problems.size() == 1 ? problems.front().field : std::to_string(problems.size());
  };
  EXPECT_EQ(field("aperture_radius: -1"), "camera.aperture_radius");
  EXPECT_EQ(field("aperture_radius: nan"), "camera.aperture_radius");
  EXPECT_EQ(field("focus_distance: 0"), "camera.focus_distance");
  EXPECT_EQ(field("aperture_radius: 1 focus_distance: 1e-9"), "camera.aperture_radius");
  EXPECT_EQ(field("aperture_radius: 1e-9 focus_distance: 1e9"), "0");
}

}  // namespace
}  // namespace metamer
