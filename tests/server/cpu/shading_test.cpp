// Where on a surface the models are evaluated, and that every one of them renders.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "common/models/registry.h"
#include "tests/server/test_scene.h"

namespace metamer {
namespace {

/// A card of 2 × 2 in front of the eye under one near light; the picture's middle is the card's.
std::string near_card(const std::string& shading) {
  return "camera { eye { z: 10 } target {} vertical_fov: 12 } "
         "light { name: 'l' position { x: 0.3 y: 0.2 z: 1 } spectrum { standard: 'E' } } "
         "material { name: 'm' diffuse { constant: 1 } } "
         "object { name: 'o' material: 'm' shading: " +
         shading +
         " quad { corner { x: -1 y: -1 } u { x: 2 } v { y: 2 } } } "
         "settings { width: 33 height: 33 spp: 1 method { point { from: 400 to: 700 step: 10 } } }";
}

/// N·L on that card.
double cosine(double x, double y) { return 1 / std::hypot(0.3 - x, 0.2 - y, 1.0); }

TEST(Shading, GouraudAndQuadraticInterpolateWhatTheirPlacesHold) {
  // The middle lies on the edge that the card's two triangles share, from (−1, −1) to (1, 1).
  const double corners = (cosine(-1, -1) + cosine(1, 1)) / 2, middle = cosine(0, 0);
  EXPECT_NEAR(test::render(near_card("GOURAUD")).at(16, 16)[1], corners, 1e-5);
  EXPECT_NEAR(test::render(near_card("QUADRATIC")).at(16, 16)[1], middle, 1e-5);
  EXPECT_NEAR(test::render(near_card("PHONG")).at(16, 16)[1], middle, 1e-5);
}

TEST(Shading, ConstantHasOneColourATriangle) {
  const auto picture = test::render(near_card("CONSTANT"));
  std::set<float> colours;
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x)
      if (picture.at(x, y)[1] > 0) colours.insert(picture.at(x, y)[1]);
  ASSERT_EQ(colours.size(), 2u);
  EXPECT_NEAR(*colours.begin(), cosine(-1.0 / 3, 1.0 / 3), 1e-5);
  EXPECT_NEAR(*colours.rbegin(), cosine(1.0 / 3, -1.0 / 3), 1e-5);
}

TEST(Shading, AnObjectsOwnShadingGoesBeforeTheScenes) {
  const auto with = [](const std::string& objects, const std::string& settings) {
    std::string text = near_card("PHONG");
    text.replace(text.find(" shading: PHONG"), 15, objects);
    text.replace(text.rfind('}'), 1, settings + " }");
    return test::render(text).xyz;
  };
  EXPECT_EQ(with("", "shading: GOURAUD"), with(" shading: GOURAUD", ""));
  EXPECT_EQ(with(" shading: GOURAUD", "shading: QUADRATIC"), with(" shading: GOURAUD", ""));
  EXPECT_NE(with("", "shading: GOURAUD"), with("", ""));
}

TEST(Shading, OverAMirrorTheCornersAreSeenFromWhereTheEyeSeemsToBe) {
  // The same card seen by an eye, and over a mirror by the image of that eye.
  const std::string common =
      "light { name: 'l' position { x: 0.5 y: 0.4 z: 1.5 } spectrum { standard: 'E' } } "
      "material { name: 'm' diffuseness: 0.3 specularness: 0.7 diffuse { constant: 1 } "
      "blinn_phong { shininess: 8 } } material { name: 'mirror' mirror: 1 } "
      "object { name: 'o' material: 'm' shading: GOURAUD quad { corner { x: -1 y: -1 } u { x: 2 } "
      "v { y: 2 } } } settings { width: 1 height: 1 spp: 1 method { point { from: 400 to: 700 "
      "step: "
      "10 } } } ";
  const auto direct =
      test::render("camera { eye { z: 8 } target {} vertical_fov: 0.01 } " + common);
  const auto mirrored = test::render(
      "camera { eye { x: 4 z: 4 } target { z: 4 } vertical_fov: 0.01 } " + common +
      "object { name: 'n' material: 'mirror' quad { corner { x: -1 y: -1 z: 3 } u { x: 2 z: 2 } "
      "v { y: 2 } } }");
  EXPECT_GT(direct.at(0, 0)[1], 0.1);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(mirrored.at(0, 0)[i] / direct.at(0, 0)[i], 1, 1e-4);
}

TEST(Shading, PhongsAmbientLightReachesTheShade) {
  const std::string scene =
      "camera { eye { z: 5 } target {} vertical_fov: 10 } "
      "light { name: 'behind' position { z: -3 } spectrum { standard: 'E' } luminance: 0.5 } "
      "material { name: 'm' diffuse { constant: 0.8 } phong { ambient: 0.25 } } "
      "object { name: 'o' material: 'm' quad { corner { x: -1 y: -1 } u { x: 2 } v { y: 2 } } } "
      "settings { width: 5 height: 5 method { point { from: 400 to: 700 step: 10 } } ";
  for (const char* shading : {"PHONG", "GOURAUD"})
    EXPECT_NEAR(test::render(scene + "shading: " + shading + " }").at(2, 2)[1], 0.5 * 0.8 * 0.25,
                1e-6);
}

/// How far a highlight reaches from the middle, to the right and up, in pixels.
std::array<int, 2> reach(const std::string& object) {
  const auto picture = test::render(
      "camera { eye { z: 6 } target {} vertical_fov: 18 } "
      "light { name: 'l' position { z: 6 } spectrum { standard: 'E' } } "
      "material { name: 'm' diffuseness: 0 specularness: 1 "
      "ward_phong { shininess_u: 10 shininess_v: 1000 } } " +
      object + " settings { width: 65 height: 65 spp: 1 }");
  std::array<int, 2> far{};
  for (std::uint32_t i = 0; i <= 32; ++i) {
    far[0] += picture.at(32 + i, 32)[1] > 0.5f ? 1 : 0;
    far[1] += picture.at(32, 32 - i)[1] > 0.5f ? 1 : 0;
  }
  return far;
}

TEST(Shading, AnisotropyFollowsTheTangents) {
  const std::string quad = "object { name: 'o' material: 'm' quad { corner { x: -1 y: -1 } ";
  const auto along_x = reach(quad + "u { x: 2 } v { y: 2 } } }");
  const auto along_y = reach(quad + "u { y: 2 } v { x: 2 } } }");
  EXPECT_GT(along_x[0], 2 * along_x[1]);
  EXPECT_GT(along_y[1], 2 * along_y[0]);
  // A sphere has its transform's x axis.
  const std::string ball = "object { name: 'o' material: 'm' sphere { radius: 1 } ";
  const auto upright = reach(ball + "}");
  const auto turned = reach(ball + "transform { rotate { axis { z: 1 } degrees: 90 } } }");
  EXPECT_GT(upright[0], 2 * upright[1]);
  EXPECT_GT(turned[1], 2 * turned[0]);
}

/// Every model with each of the parts that it can have.
std::vector<std::string> materials() {
  using models::Kind;
  std::vector<std::string> all;
  for (const auto& model : models::registry(Kind::model)) {
    const std::string name = std::string(model.name) + " {}";
    std::string weights = model.traits & models::weighted ? "diffuseness: 0.6 " : "";
    if (model.traits & models::highlighted) weights += "specularness: 0.4 ";
    all.push_back(weights + name);
    for (const auto& term : models::registry(Kind::diffuse))
      all.push_back(weights + name + " " + term.name + " {}");
    if (model.traits & models::has_facets)
      for (const auto& slope : models::registry(Kind::slope))
        for (const auto& attenuation : models::registry(Kind::attenuation))
          all.push_back(weights + name + " slope { weight: 0.75 " + slope.name +
                        " {} } slope { weight: 0.25 beckmann {} } attenuation: " +
                        std::to_string(attenuation.number));
    if (model.traits & models::has_fresnel)
      for (const char* fresnel :
           {"schlick {}", "dielectric { medium: 'diamond' }", "conductor { metal: 'Cu' }",
            "dielectric { reflectance { constant: 0.1 } }",
            "dielectric { sellmeier { b: 1.04 c: 0.006 } }",
            "dielectric { cauchy { a: 1.5 b: 0.004 } }",
            "conductor { n { constant: 0.2 } k { constant: 3 } }"})
        all.push_back(weights + name + " mirror: 0.2 fresnel { " + fresnel + " }");
  }
  return all;
}

TEST(Shading, EveryModelWithEachOfItsPartsAndEachShadingGivesAPicture) {
  const auto all = materials();
  EXPECT_GT(all.size(), 60u);
  for (const std::string& material : all)
    for (const char* shading : {"PHONG", "CONSTANT", "GOURAUD", "QUADRATIC"}) {
      const auto picture = test::render(
          "camera { eye { y: 1 z: 4 } target {} vertical_fov: 35 } "
          "light { name: 'a' position { x: 1 y: 2 z: 3 } spectrum { standard: 'D65' } solid_angle: "
          "0.1 } light { name: 'b' direction { x: 1 y: -1 } spectrum { standard: 'F11' } } "
          "material { name: 'm' diffuse { constant: 0.5 } " +
          material +
          " } object { name: 'q' material: 'm' quad { corner { x: -1 y: -0.5 z: 1 } u { x: 2 } v { "
          "z: -2 } } } object { name: 's' material: 'm' sphere { center { y: 0.2 } radius: 0.4 } } "
          "settings { width: 16 height: 12 spp: 2 depth: 2 method { rgb {} } shading: " +
          shading + " }");
      float brightest = 0;
      for (const float value : picture.xyz) {
        ASSERT_TRUE(std::isfinite(value)) << material << " " << shading;
        brightest = std::max(brightest, value);
      }
      EXPECT_GT(brightest, 0.01f) << material << " " << shading;
    }
}

}  // namespace
}  // namespace metamer
