#include "server/cpu/texturing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/color/lab.h"
#include "common/color/rgb_space.h"
#include "tests/server/methods/methods.h"
#include "tests/server/scene/small_png.h"
#include "tests/server/test_scene.h"

namespace metamer {
namespace {

const std::string ink_spectra =
    "spectrum { samples { wavelength: [400, 500, 600, 700] value: [0.1, 0.2, 0.8, 0.9] } "
    "           interpolation: LINEAR } "
    "spectrum { samples { wavelength: [400, 500, 600, 700] value: [0.7, 0.3, 0.1, 0.2] } "
    "           interpolation: LINEAR } ";
const std::string printed =
    "diffuse { constant: 0.8 } texture { file: 'print.png' channel: ['R', 'G'] " + ink_spectra +
    "}";

/// A card that fills the picture, seen head on from a distance of 5, lit along the eye's direction.
std::string card(
    const std::string& material, const std::string& settings,
    const std::string& shape = "quad { corner { x: -1 y: -1 } u { x: 2 } v { y: 2 } }") {
  return "camera { eye { z: 5 } target {} vertical_fov: 22.61986495 } "
         "light { name: 'l' direction { z: -1 } spectrum { standard: 'F11' } } "
         "material { name: 'card' " +
         material +
         " } "
         "object { name: 'card' material: 'card' " +
         shape + " } settings { width: 16 height: 16 " + settings + " }";
}

TEST(Texturing, SharesOfInksAndGroundAreOneSpectrumForEveryMethod) {
  // A fifth and two fifths of the inks, the rest ground: 51 and 102 of 255.
  const std::string mixed =
      "diffuse { samples { wavelength: [400, 500, 600, 700] value: [0.62, 0.48, 0.52, 0.58] } "
      "          interpolation: LINEAR }";
  const test::Files files{{"print.png", test::small_png(1, 1, 2, {'\x33', '\x66', '\xFF'})}};
  for (const v1::Method& method : test::all_methods()) {
    const std::string settings = "spp: 2 method { " + method.ShortDebugString() + " }";
    const auto of_texture = test::render(card(printed, settings), files).at(8, 8),
               of_mixture = test::render(card(mixed, settings)).at(8, 8);
    const auto lab = [](const std::array<float, 3>& c) {
      return to_lab({c[0], c[1], c[2]}, {0.9505, 1, 1.089});
    };
    // Methods that are made for a scene know three spectra in one and one in the other.
    const bool made_for_scene = method.has_linear() || method.point().fitted() > 0;
    EXPECT_LT(delta_e_00(lab(of_texture), lab(of_mixture)), made_for_scene ? 6 : 0.01)
        << method.ShortDebugString();
    if (!method.has_exact()) continue;
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(of_texture[i], of_mixture[i], 2e-5);
  }
}

/// One ink on black, at the four corners of a picture: 255, 170 / 85, 0.
const test::Files corners{{"print.png", test::small_png(2, 2, 0, {'\xFF', '\xAA', '\x55', '\0'})}};
const std::string one_ink = "texture { file: 'print.png' spectrum { constant: 1 } wrap: CLAMP }";

TEST(Texturing, AQuadsPictureStandsUprightAlongItsSides) {
  const auto picture = test::render(card(one_ink, "spp: 1"), corners);
  const float white = picture.at(1, 1)[1];
  EXPECT_NEAR(picture.at(14, 1)[1] / white, 170 / 255.0, 1e-3);
  EXPECT_NEAR(picture.at(1, 14)[1] / white, 85 / 255.0, 1e-3);
  EXPECT_EQ(picture.at(14, 14)[1], 0);
}

TEST(Texturing, AMeshsPictureGoesByItsUvs) {
  // The card again, its u and v exchanged.
  test::Files files = corners;
  files["card.obj"] =
      "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 0 1\nvt 1 1\nvt 1 0\nf 1/1 2/2 3/3 4/4\n";
  const auto picture = test::render(card(one_ink, "spp: 1", "mesh { file: 'card.obj' }"), files);
  const float white = picture.at(14, 14)[1];  // v = 1 is at the right, u = 0 below
  EXPECT_GT(white, 0);
  EXPECT_NEAR(picture.at(14, 1)[1] / white, 170 / 255.0, 1e-3);
  EXPECT_NEAR(picture.at(1, 14)[1] / white, 85 / 255.0, 1e-3);
  EXPECT_EQ(picture.at(1, 1)[1], 0);
}

TEST(Texturing, ASpheresPictureHasItsMiddleTowardsZAndItsTopAtY) {
  // Ink on the upper half of the quarter to the east of the middle.
  std::string map;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) map += x >= 32 && x < 48 && y < 16 ? '\xFF' : '\0';
  const auto picture = test::render(card(one_ink, "spp: 1", "sphere { radius: 0.9 }"),
                                    {{"print.png", test::small_png(64, 32, 0, map)}});
  EXPECT_GT(picture.at(10, 5)[1], 0.5f);
  EXPECT_EQ(picture.at(5, 5)[1], 0);
  EXPECT_EQ(picture.at(5, 11)[1], 0);
  EXPECT_EQ(picture.at(10, 11)[1], 0);
}

TEST(Texturing, APlanesPictureRepeatsByMetres) {
  // The card's place as a plane: a metre of it is half the picture's width.
  const std::string repeated = "texture { file: 'print.png' spectrum { constant: 1 } }";
  const auto picture = test::render(card(repeated, "spp: 1", "plane { normal { z: 1 } }"), corners);
  for (std::uint32_t y = 0; y < 8; ++y)
    for (std::uint32_t x = 0; x < 8; ++x) {
      EXPECT_NEAR(picture.at(x, y)[1], picture.at(x + 8, y)[1], 1e-4) << x << ", " << y;
      EXPECT_NEAR(picture.at(x, y)[1], picture.at(x, y + 8)[1], 1e-4) << x << ", " << y;
    }
  EXPECT_GT(picture.at(1, 1)[1], 2 * picture.at(5, 5)[1]);
}

TEST(Texturing, FarAwayAFinePictureIsItsMean) {
  std::string chequer;
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) chequer += (x + y) % 2 ? '\xFF' : '\0';
  const test::Files files{{"print.png", test::small_png(256, 256, 0, chequer)}};
  const std::string whole = "texture { file: 'print.png' spectrum { constant: 1 } }";
  const auto picture = test::render(card(whole, "spp: 1"), files),
             white = test::render(card("diffuse { constant: 1 }", "spp: 1"));
  for (std::uint32_t y = 2; y < 14; ++y)
    for (std::uint32_t x = 2; x < 14; ++x)
      EXPECT_NEAR(picture.at(x, y)[1] / white.at(x, y)[1], 0.5, 2e-3) << x << ", " << y;
}

TEST(Texturing, ScaleOffsetAndRotationMoveThePicture) {
  // Turned by a quarter about 0, 0 and moved back by 1: what was at the left is at the bottom.
  const std::string turned =
      "texture { file: 'print.png' spectrum { constant: 1 } wrap: CLAMP rotation: 90 offset { u: 1 "
      "} }";
  const auto picture = test::render(card(turned, "spp: 1"), corners);
  // At the card's lower left (u, v) = (0, 0) the picture is read at (1, 0): 0.
  EXPECT_EQ(picture.at(1, 14)[1], 0);
  EXPECT_NEAR(picture.at(14, 1)[1], 1, 0.02);  // (1, 1) → (0, 1): 255
  const std::string twice =
      "texture { file: 'print.png' spectrum { constant: 1 } scale { u: 2 v: 1 } }";
  const auto repeated = test::render(card(twice, "spp: 1"), corners);
  for (std::uint32_t x = 0; x < 8; ++x)
    EXPECT_NEAR(repeated.at(x, 3)[1], repeated.at(x + 8, 3)[1], 1e-4) << x;
}

TEST(Texturing, IsSeenInMirrors) {
  // The card behind the eye, in a mirror that fills the picture, is the mean of its mixture.
  const auto scene = [](const std::string& material) {
    return "camera { eye {} target { z: -1 } vertical_fov: 20 } "
           "light { name: 'l' direction { x: 0.5 z: 1 } spectrum { standard: 'D65' } } "
           "material { name: 'mirror' mirror: 1 diffuse { constant: 0 } } "
           "material { name: 'card' " +
           material +
           " } "
           "object { name: 'm' material: 'mirror' quad { corner { x: -1 y: -1 z: -2 } u { x: 2 } v "
           "{ y: 2 } } } "
           "object { name: 'c' material: 'card' quad { corner { x: -9 y: -9 z: 3 } u { x: 18 } v { "
           "y: 18 } } } "
           "settings { width: 8 height: 8 spp: 2 }";
  };
  const test::Files files{{"print.png", test::small_png(1, 1, 2, {'\x33', '\x66', '\xFF'})}};
  const auto seen = test::render(scene(printed), files).at(4, 4);
  const auto mixed =
      test::render(scene("diffuse { samples { wavelength: [400, 500, 600, 700] value: "
                         "[0.62, 0.48, 0.52, 0.58] } interpolation: LINEAR }"))
          .at(4, 4);
  EXPECT_GT(mixed[1], 0.1f);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(seen[i], mixed[i], 3e-5);
}

TEST(Texturing, AMeshWithoutUvsIsAProblemOfItsObject) {
  test::Files files = corners;
  files["card.obj"] = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\n";
  try {
    test::compile_text(card(one_ink, "spp: 1", "mesh { file: 'card.obj' }"), files);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "object[0]: its mesh has no UVs, which the texture of \"card\" needs");
  }
}

/// Linear sRGB of 8 bits, IEC 61966-2-1.
double decoded(int value) {
  const double v = value / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

TEST(Texturing, AColourIsItselfUnderD65) {
  std::string card_text = card("texture { file: 'print.png' use: RGB }", "spp: 1");
  card_text.replace(card_text.find("F11"), 3, "D65");
  for (const std::array<int, 3> rgb : {std::array{200, 30, 90}, {10, 200, 60}, {255, 255, 0}}) {
    const std::string pixel{static_cast<char>(rgb[0]), static_cast<char>(rgb[1]),
                            static_cast<char>(rgb[2])};
    const auto seen =
        test::render(card_text, {{"print.png", test::small_png(1, 1, 2, pixel)}}).at(8, 8);
    const Rgb linear =
        multiply(rgb_space(StandardSpace::srgb).from_xyz, Vector3{seen[0], seen[1], seen[2]});
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(linear[c], decoded(rgb[c]), 0.006) << rgb[0];
  }
}

TEST(Texturing, AGreyOfColoursIsAGreySurfaceUnderEveryLight) {
  const auto of_colors =
      test::render(card("texture { file: 'print.png' use: RGB }", "spp: 1"),
                   {{"print.png", test::small_png(1, 1, 2, {'\x80', '\x80', '\x80'})}})
          .at(8, 8);
  const auto grey =
      test::render(card("diffuse { constant: " + std::to_string(decoded(128)) + " }", "spp: 1"))
          .at(8, 8);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(of_colors[c], grey[c], 3e-5);
}

TEST(Texturing, SpectraOfTexturesAreMaterialsOfTheirOwn) {
  const RenderScene scene = test::compile_text(
      card(printed, "spp: 1"), {{"print.png", test::small_png(1, 1, 2, {'\x33', '\x66', '\0'})}});
  ASSERT_EQ(scene.materials.size(), 3u);
  EXPECT_EQ(scene.materials[1].name, "card#1");
  EXPECT_EQ(scene.materials[2].name, "card#2");
  EXPECT_EQ(seen_materials(scene), (std::set<std::uint32_t>{0, 1, 2}));
}

}  // namespace
}  // namespace metamer
