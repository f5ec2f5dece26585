// Light from all around: what it sends to a white, where its picture is seen, and what is refused.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "server/cpu/soft/sky.h"
#include "server/plan/reference.h"
#include "server/scene/compile.h"
#include "tests/server/cpu/soft/sky_file.h"
#include "tests/server/test_scene.h"

namespace metamer {
namespace {

using Pixels = std::vector<std::array<float, 3>>;
constexpr std::array<float, 3> grey = {1, 1, 1};

std::string sky(const std::string& environment, const std::string& light = "") {
  return "light { name: 'sky' environment { " + environment + " } spectrum { standard: 'D65' } " +
         light + " } ";
}
const std::string picture = "file: 'sky.exr'";

/// X Y Z of a white card of this material on the ground.
std::array<float, 3> ground(const std::string& light, const test::Files& files = {},
                            const std::string& settings = "spp: 16 light_samples: 16") {
  return test::render("camera { eye { y: 10 } target {} up { z: -1 } vertical_fov: 1 } " + light +
                          "material { name: 'white' diffuse { constant: 1 } } object { name: "
                          "'floor' material: 'white' plane {} } settings { width: 1 height: 1 " +
                          settings + " }",
                      files)
      .at(0, 0);
}

TEST(Environment, ConstantMakesADiffuseWhiteAsBrightAsItsLuminance) {
  EXPECT_NEAR(ground(sky(""))[1], 1, 1e-3);
  EXPECT_NEAR(ground(sky("", "luminance: 0.3"))[1], 0.3, 3e-4);
}

TEST(Environment, TheErrorOfSamplingShrinks) {
  double few = 0, many = 0;
  for (int turn = 0; turn < 8; ++turn) {
    const std::string of = sky(picture + " rotation: " + std::to_string(45 * turn));
    const test::Files files = {{"sky.exr", test::sky_file(4, 4, Pixels(16, grey))}};
    few += std::abs(ground(of, files, "spp: 1 light_samples: 4")[1] - 1);
    many += std::abs(ground(of, files, "spp: 16 light_samples: 64")[1] - 1);
  }
  EXPECT_LT(many, 0.05 * few);
}

TEST(Environment, APictureOfAnySizeAndScaleHasItsLuminanceOnTheGround) {
  // A gradient in both directions, and colours.
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 1}, {1, 2}, {8, 4}, {64, 33}}) {
    Pixels pixels;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        pixels.push_back(
            {1e4F * static_cast<float>(x + 1), 3e4F, 2e4F * static_cast<float>(y + 1)});
    const test::Files files = {{"sky.exr", test::sky_file(width, height, pixels)}};
    EXPECT_NEAR(ground(sky(picture, "luminance: 0.8"), files, "spp: 64 light_samples: 16")[1], 0.8,
                4e-3)
        << width << " x " << height;
  }
}

TEST(Environment, AGreyPictureHasTheLightsOwnColour) {
  const test::Files files = {{"sky.exr", test::sky_file(2, 2, Pixels(4, grey))}};
  const auto xyz = ground(sky(picture), files);
  EXPECT_NEAR(xyz[0] / xyz[1], 0.95047, 5e-4);  // D65, CIE 15
  EXPECT_NEAR(xyz[2] / xyz[1], 1.08883, 5e-4);
}

/// What a camera at the origin sees in a direction; a small ball far below is all else that there
/// is.
std::array<float, 3> seen(const std::array<double, 3>& d, const std::string& light,
                          const test::Files& files) {
  const auto vector = [](const std::array<double, 3>& v) {
    return "x: " + std::to_string(v[0]) + " y: " + std::to_string(v[1]) +
           " z: " + std::to_string(v[2]);
  };
  return test::render("camera { eye {} target { " + vector(d) + " } up { x: 0.1 y: 1 z: 0.2 } " +
                          "vertical_fov: 0.1 } " + light +
                          "material { name: 'm' } object { name: 'o' material: 'm' sphere { center "
                          "{ y: -1e4 x: 1e4 } radius: 1 } } settings { width: 1 height: 1 }",
                      files)
      .at(0, 0);
}

TEST(Environment, ItsMiddleIsAtMinusZAndItsTopAbove) {
  // Luminances 1 to 8 in a 4 × 2 picture: columns begin behind (+z), go over −x, −z and +x.
  Pixels pixels;
  for (int i = 1; i <= 8; ++i) pixels.push_back(Pixels::value_type{float(i), float(i), float(i)});
  const test::Files files = {{"sky.exr", test::sky_file(4, 2, pixels)}};
  const double whole = 2.5;  // the mean of the upper row: what the ground has
  const double a = 0.7;      // between two axes, a little above or below the horizon
  struct Case {
    std::array<double, 3> direction;
    int pixel;
  };
  for (const Case& one : {Case{{-a, 0.1, a}, 1},
                          {{-a, 0.1, -a}, 2},
                          {{a, 0.1, -a}, 3},
                          {{a, 0.1, a}, 4},
                          {{-a, -0.1, a}, 5},
                          {{a, -0.1, a}, 8},
                          {{0.1, 9, 0.1}, 4}})
    EXPECT_NEAR(seen(one.direction, sky(picture), files)[1], one.pixel / whole, 1e-4) << one.pixel;
  // A quarter turn counterclockwise brings what was at −z to −x.
  EXPECT_NEAR(seen({-a, 0.1, a}, sky(picture + " rotation: 90"), files)[1], 2 / whole, 1e-4);
}

TEST(Environment, AMirrorShowsItWhereTheLawOfReflectionSaysAndTheEyeNeedNotSeeIt) {
  Pixels pixels(16 * 8, {0.01F, 0.01F, 0.01F});
  // One bright pixel: 45° above the horizon, over +x: row 2 of 8, column 12 of 16.
  for (std::size_t i : {16 * 1 + 12, 16 * 2 + 12, 16 * 1 + 11, 16 * 2 + 11}) pixels[i] = {9, 9, 9};
  const test::Files files = {{"sky.exr", test::sky_file(16, 8, pixels)}};
  // A ball seen along −z: it reflects (1, 1, 0)/√2 where its normal is halfway to the eye.
  const double n[] = {0.5, 0.5, std::numbers::sqrt2 / 2};
  const auto y = [&](double x, double up, const std::string& light) {
    return test::render("camera { eye { z: 1000 x: " + std::to_string(x) +
                            " y: " + std::to_string(up) + " } target { x: " + std::to_string(x) +
                            " y: " + std::to_string(up) + " } vertical_fov: 1e-3 } " + light +
                            "material { name: 'm' mirror: 1 diffuse { constant: 0 } "
                            "} object { name: 'o' material: 'm' sphere { radius: 1 } } settings { "
                            "width: 1 height: 1 }",
                        files)
        .at(0, 0)[1];
  };
  const float background = y(1.5, 0, sky(picture));
  EXPECT_GT(background, 0);
  EXPECT_NEAR(y(n[0], n[1], sky(picture)), 900 * background, 10 * background);
  EXPECT_NEAR(y(n[0], -n[1], sky(picture)), background, 1e-3 * background);
  EXPECT_NEAR(y(-n[0], n[1], sky(picture)), background, 1e-3 * background);
  EXPECT_EQ(y(1.5, 0, sky(picture, "visible: false")), 0);
  EXPECT_NEAR(y(n[0], n[1], sky(picture, "visible: false")), 900 * background, 10 * background);
}

/// The first thing that is wrong with a scene under such a picture.
std::string refused(const Pixels& pixels, int width = 1) {
  const std::string text = "camera { eye { z: 10 } target {} } " + sky(picture) +
                           "material { name: 'm' } object { name: 'o' material: 'm' plane {} }";
  const std::atomic<bool> never = false;
  const AssetReader files = [&](const std::string&) -> Result<std::string> {
    return test::sky_file(width, static_cast<int>(pixels.size()) / width, pixels);
  };
  const auto compiled =
      compile_scene(test::parse_scene(text), files, import_here(files), textures_of(files), never);
  if (compiled) return "";
  EXPECT_EQ(compiled.error().front().field, "light[0].environment.file");
  return compiled.error().front().message;
}

TEST(Environment, APixelThatIsNoLightIsNamed) {
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(refused({grey, grey, grey, {1, -1, 1}}, 2),
            "pixel 1, 1 is -1; light is 0 or more, and at most 1e30");
  EXPECT_EQ(refused({{1, std::nanf(""), 1}}),
            "pixel 0, 0 is nan; light is 0 or more, and at most "
            "1e30");
  EXPECT_EQ(refused({grey, {infinity, 1, 1}}),
            "pixel 0, 1 is inf; light is 0 or more, and at most 1e30");
  EXPECT_EQ(refused({{0, 0, 0}}), "the picture is black: no light comes from it");
  EXPECT_EQ(refused({{0, 0, 0}, grey}),
            "nothing shines from above the horizon, where its luminance is measured: a perfect "
            "white on the ground would be black");
  EXPECT_EQ(refused({grey, {0, 0, 0}}), "");
}

TEST(Environment, EveryMethodCarriesItsThreeLights) {
  Pixels pixels;
  for (int i = 0; i < 8; ++i)
    pixels.push_back(
        {0.2F + 0.3F * float(i % 4), 0.9F - 0.2F * float(i % 3), 0.4F + 0.1F * float(i)});
  const test::Files files = {{"sky.exr", test::sky_file(4, 2, pixels)}};
  const auto with = [&](const std::string& method) {
    return test::render("camera { eye { z: 4 y: 1 } target {} } " + sky(picture) +
                            "material { name: 'm' diffuse { samples { wavelength: [400, 540, 700] "
                            "value: [0.1, 0.8, 0.1] } } mirror: 0.3 } object { name: 'o' material: "
                            "'m' sphere { radius: 1 } } settings { width: 16 height: 16 method { " +
                            method + " } }",
                        files);
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

TEST(Environment, TheBandsOfASpectralPictureAreTheSpectrumThatTheySay) {
  // Alike in all directions: what a light of these samples sends, straight lines between them.
  const std::vector<std::string> bands = {"S0.400,000000nm", "S0.450,000000nm", "S0.520,000000nm",
                                          "S0.600,000000nm", "S0.700,000000nm"};
  const test::Files files = {
      {"sky.exr", test::sky_file(1, 2, bands, {{1, 3, 2, 5, 4}, {1, 3, 2, 5, 4}})}};
  const std::string flat =
      "light { name: 'sky' environment { file: 'sky.exr' } spectrum { constant: 1 } } ";
  const std::string samples =
      "light { name: 'sky' environment {} spectrum { samples { wavelength: [350, 400, 450, 520, "
      "600, 700, 800] value: [0, 1, 3, 2, 5, 4, 0] } interpolation: LINEAR } } ";
  const auto own = ground(flat, files), expected = ground(samples);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(own[i], expected[i], 3e-3 * expected[i]);
  // Each where it is: one band above, another below.
  const test::Files split = {
      {"sky.exr", test::sky_file(1, 2, bands, {{0, 1, 0, 0, 0}, {0, 0, 0, 1, 0}})}};
  const auto blue = seen({0.3, 1, -0.2}, flat, split), red = seen({0.3, -0.1, -0.2}, flat, split);
  EXPECT_NEAR(blue[1], 1, 1e-4);
  EXPECT_GT(blue[2], 5 * blue[1]);
  EXPECT_LT(red[2], 0.01F * red[1]);
}

/// Y of what is seen of a clear ball of radius 1 around the origin, by pixels across it.
std::vector<float> ball(const std::string& light, const std::string& medium) {
  const auto picture = test::render(
      "camera { eye { z: 5 } target {} vertical_fov: 20 } " + light + "material { name: 'clear' " +
      medium + " } object { name: 'ball' material: 'clear' sphere { radius: 1 } } settings { " +
      "width: 9 height: 9 depth: 64 cutoff: 1e-6 }");
  std::vector<float> y;
  for (std::uint32_t i = 0; i < 9; ++i) y.push_back(picture.at(i, 4)[1]);
  return y;
}

TEST(Environment, AGlassBallInAUniformOneIsNotSeen) {
  const std::string glass = "fresnel { dielectric { n { constant: 1.5 } } } transmission {}";
  for (const float y : ball(sky(""), glass)) EXPECT_NEAR(y, 1, 1e-3);
}

TEST(Environment, WhatShinesIsSeenThroughWhatAbsorbs) {
  const std::string tinted =
      "fresnel { dielectric { n { constant: 1 } } } transmission { transmittance { constant: 0.5 } "
      "thickness: 1 }";
  // The middle pixel is a fifth of the radius wide.
  EXPECT_NEAR(ball(sky(""), tinted)[4], 0.25, 3e-3);
  const std::string lamp =
      "light { name: 'lamp' sphere { radius: 0.4 } spectrum { standard: 'D65' } } ";
  EXPECT_NEAR(ball(lamp, tinted)[4], std::pow(0.5, 0.6), 3e-3);
}

TEST(Environment, ALargePictureIsAveragedDown) {
  // One row of 5000 pixels: every value is kept on the whole.
  Pixels pixels;
  for (int i = 0; i < 5000; ++i) pixels.push_back({float(i % 7), 1, 2});
  const auto read = read_sky_picture(test::sky_file(5000, 1, pixels), "sky.exr");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->picture.width, max_sky_width);
  EXPECT_EQ(read->notes, std::vector<std::string>{"averaged from 5000 × 1 to 4096 × 1 pixels"});
  double before = 0, after = 0;
  for (const auto& pixel : pixels) before += double{pixel[0]} / 5000;
  for (std::uint32_t x = 0; x < max_sky_width; ++x)
    after += double{read->picture.at(x, 0)[0]} / max_sky_width;
  EXPECT_NEAR(after, before, 1e-5);
}

TEST(Plane, KeepsItsStripAtAHundredThousandTimesTheView) {
  // From a metre above, rows that meet the floor at so many metres, lit from 60° above.
  for (const double distance : {1.0, 1e3, 1e5, 1e7})
    for (const std::string offset : {"0", "1e6"}) {
      const auto picture = test::render(
          "camera { eye { y: 1 x: " + offset + " } target { y: 0 x: " + offset + " z: -" +
          std::to_string(distance) +
          " } vertical_fov: 1e-6 } light { name: 'l' direction { x: 0.866025404 y: -0.5 } spectrum "
          "{ standard: 'E' } } material { name: 'm' diffuse { constant: 1 } } object { name: "
          "'floor' material: 'm' plane {} } object { name: 'ball' material: 'm' sphere { center { "
          "x: " +
          offset + " z: 5 } radius: 1 } } settings { width: 1 height: 9 }");
      for (std::uint32_t y = 0; y < 9; ++y)
        EXPECT_NEAR(picture.at(0, y)[1], 0.5, 1e-5) << distance << " " << offset;
    }
}

TEST(Plane, CastsAndReceivesShadowsAndIsPlacedByItsTransform) {
  const auto middle = [](const std::string& plane) {
    return test::render(
               "camera { eye { z: 5 } target {} vertical_fov: 1 } light { name: 'l' position { z: "
               "9 "
               "x: 3 } spectrum { standard: 'E' } } material { name: 'm' diffuse { constant: 1 } } "
               "object { name: 'card' material: 'm' quad { corner { x: -1 y: -1 } u { x: 2 } v { "
               "y: "
               "2 } } } object { name: 'wall' material: 'm' plane " +
               plane + " } settings { width: 1 height: 1 }")
        .at(0, 0)[1];
  };
  const float lit = middle("{ point { z: -1 } normal { z: 1 } }");
  EXPECT_GT(lit, 0.9);
  EXPECT_EQ(middle("{ point { x: 2 } normal { x: 1 z: -0.001 } }"), 0);
  EXPECT_EQ(middle("{ point { x: 20 } normal { x: 1 } }"), lit);
  EXPECT_EQ(middle("{} transform { rotate { axis { z: 1 } degrees: 90 } } transform { translate { "
                   "x: 1.5 } }"),
            0);
}

/// Differences are seen under the sky as a whole, and not under the first of its parts.
TEST(Sky, OfAGreyPictureHasTheWhiteOfAConstantOne) {
  const auto scene = [](const std::string& file) {
    return "camera { eye { z: 5 } target {} } light { name: 'sky' environment {" + file +
           "} spectrum { standard: 'A' } luminance: 0.7 } "
           "material { name: 'm' } object { name: 'o' material: 'm' sphere { radius: 1 } }";
  };
  const test::Files files = {
      {"sky.exr",
       test::sky_file(2, 2, {"B", "G", "R"}, std::vector<std::vector<float>>(4, {2, 2, 2}))}};
  const RenderScene of_picture = test::compile_text(scene(" file: 'sky.exr' "), files),
                    constant = test::compile_text(scene(""));
  const Xyz white = Reference(of_picture, of_picture.observer).white(),
            expected = Reference(constant, constant.observer).white();
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(white[i], expected[i], 1e-6);
}

}  // namespace
}  // namespace metamer
