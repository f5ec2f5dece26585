#include "server/cpu/cutouts.h"

#include <gtest/gtest.h>

#include "tests/server/methods/methods.h"
#include "tests/server/scene/small_png.h"
#include "tests/server/test_scene.h"

namespace metamer {
namespace {

std::string spectrum(double at_400, double at_700) {
  return "diffuse { samples { wavelength: [400, 700] value: [" + std::to_string(at_400) + ", " +
         std::to_string(at_700) + "] } interpolation: LINEAR } ";
}

/// A sheet before a wall, lit along the eye's direction.
std::string sheet(
    const std::string& material, const std::string& settings = "spp: 1",
    const std::string& shape = "quad { corner { x: -1 y: -1 } u { x: 2 } v { y: 2 } }",
    const std::string& light = "direction { z: -1 }") {
  return "camera { eye { z: 5 } target {} vertical_fov: 22.61986495 } "
         "light { name: 'l' " +
         light + " spectrum { standard: 'F11' } } material { name: 'wall' " + spectrum(0.2, 0.9) +
         "} material { name: 'sheet' " + spectrum(0.8, 0.1) + material +
         " } object { name: 'wall' material: 'wall' quad { corner { x: -9 y: -9 z: -1 } u { x: 18 "
         "} v { y: 18 } } } object { name: 'sheet' material: 'sheet' " +
         shape + " } settings { width: 16 height: 16 " + settings + " }";
}
const std::string alpha = "alpha { file: 'a.png' }";
test::Files share(unsigned char value) {
  return {{"a.png", test::small_png(1, 1, 0, {static_cast<char>(value)})}};
}

TEST(Cutouts, WhatIsAllThereOrNotAtAllIsAsIfItWereSo) {
  for (const std::string settings : {"spp: 1", "spp: 2 bounces: 2 bounce_samples: 2"}) {
    const auto whole = test::render(sheet(alpha, settings), share(255)),
               opaque = test::render(sheet("", settings)),
               none = test::render(sheet(alpha, settings), share(0)),
               wall = test::render(sheet("", settings, "sphere { center { x: 99 } radius: 1 }"));
    for (std::size_t i = 0; i < whole.xyz.size(); ++i) {
      EXPECT_NEAR(whole.xyz[i], opaque.xyz[i], 1e-5);
      EXPECT_NEAR(none.xyz[i], wall.xyz[i], 1e-5);
    }
  }
}

/// The sheet's light passes it twice: once to the wall, which its shadow lies on, once to the eye.
TEST(Cutouts, AShareIsAddedToWhatShowsThroughTheRestByEveryMethod) {
  constexpr double a = 51 / 255.0;
  for (const v1::Method& method : test::all_methods()) {
    const std::string settings = "spp: 2 method { " + method.ShortDebugString() + " }";
    const auto part = test::render(sheet(alpha, settings), share(51)).at(8, 8),
               front = test::render(sheet(alpha, settings), share(255)).at(8, 8),
               behind = test::render(sheet(alpha, settings), share(0)).at(8, 8);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(part[c], a * front[c] + (1 - a) * (1 - a) * behind[c], 1e-5)
          << method.ShortDebugString();
  }
}

TEST(Cutouts, ShadowsOfSeveralSheetsMultiply) {
  // Between the light, from the side, and the wall: three sheets of a half, none before the eye.
  const auto between = [](int sheets) {
    std::string text =
        sheet(alpha, "spp: 1", "quad { corner { x: 2 y: -9 z: -3 } u { z: 8 } v { y: 18 } }",
              "direction { x: -1 z: -0.5 }");
    for (int i = 1; i < sheets; ++i)
      text += " object { name: 's" + std::to_string(i) +
              "' material: 'sheet' quad { corner { x: " + std::to_string(2 + i) +
              " y: -9 z: -3 } u { z: 8 } v { y: 18 } } }";
    return text;
  };
  const double lit = double{test::render(between(1), share(0)).at(8, 8)[1]};
  for (const int sheets : {1, 2, 3})
    EXPECT_NEAR(double{test::render(between(sheets), share(51)).at(8, 8)[1]},
                lit * std::pow(0.8, sheets), 1e-5);
}

TEST(Cutouts, SoftShadowsAreWeighedToo) {
  // The wall is seen past the sheet; all of the lamp is behind it.
  const auto lamp = [](int value) {
    return test::render(sheet(alpha, "spp: 4 light_samples: 16",
                              "quad { corner { x: 2 y: -9 z: -3 } u { z: 8 } v { y: 18 } }",
                              "sphere { center { x: 8 z: 3 } radius: 0.5 }"),
                        share(static_cast<unsigned char>(value)))
        .at(8, 8);
  };
  const auto none = lamp(0), part = lamp(51);
  EXPECT_GT(none[1], 5e-4f);
  EXPECT_NEAR(part[1] / none[1], 0.8, 1e-4);
}

TEST(Cutouts, ACutoffIsAHardEdge) {
  // 0 to 255 from left to right: half of it is a hole, and what is there is all there.
  const test::Files files{{"a.png", test::small_png(2, 1, 0, {'\0', '\xFF'})}};
  const std::string hard = "alpha { file: 'a.png' wrap: CLAMP cutoff: 0.5 }";
  const auto picture = test::render(sheet(hard), files), whole = test::render(sheet("")),
             none = test::render(sheet(alpha), share(0));
  for (std::uint32_t x = 0; x < 16; ++x)
    EXPECT_NEAR(picture.at(x, 5)[1], (x < 8 ? none : whole).at(x, 5)[1], 1e-6) << x;
  // At the cutoff it is there.
  const std::string at = "alpha { file: 'a.png' cutoff: 0.2 }";
  EXPECT_NEAR(test::render(sheet(at), share(51)).at(8, 8)[1], whole.at(8, 8)[1], 1e-6);
  EXPECT_NEAR(test::render(sheet(at), share(50)).at(8, 8)[1], none.at(8, 8)[1], 1e-6);
}

TEST(Cutouts, OnAMeshItsEdgesBetweenTrianglesCountOnce) {
  // The diagonal goes through the middles of pixels.
  test::Files files = share(102);
  files["s.obj"] =
      "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\n"
      "f 1/1 3/3 4/4\n";
  const auto picture = test::render(sheet(alpha, "spp: 1", "mesh { file: 's.obj' }"), files);
  for (std::uint32_t i = 1; i < 15; ++i) {
    EXPECT_NEAR(picture.at(i, 15 - i)[1], picture.at(8, 8)[1], 1e-5) << i;
    EXPECT_NEAR(picture.at(i, 3)[1], picture.at(8, 8)[1], 1e-5) << i;
  }
}

TEST(Cutouts, SheetsThatTouchAreOne) {
  // As exporters write leaves: a face for each side.
  test::Files files = share(102);
  const std::string leaf =
      "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
      "f 1/1 2/2 3/3 4/4\n";
  files["one.obj"] = leaf;
  files["two.obj"] = leaf + "f 4/4 3/3 2/2 1/1\n";
  const auto of = [&](const std::string& file) {
    return test::render(sheet(alpha, "spp: 1", "mesh { file: '" + file + "' }"), files).at(7, 9)[1];
  };
  EXPECT_NEAR(of("one.obj"), of("two.obj"), 1e-5);
}

TEST(Cutouts, APlaneAndASphereHaveThem) {
  constexpr double a = 102 / 255.0;
  for (const std::string shape : {"plane { normal { z: 1 } }", "sphere { radius: 0.9 }"}) {
    const auto of = [&](int value) {
      return double{
          test::render(sheet(alpha, "spp: 1", shape), share(static_cast<unsigned char>(value)))
              .at(8, 8)[1]};
    };
    // Of a sphere the far side's inside is seen, too, and its light passes the near side twice.
    const double layers = shape[0] == 's' ? 2 : 1, front = of(255), behind = of(0);
    const double through = std::pow(1 - a, 2 * layers) * behind,
                 far = shape[0] == 's' ? a * (1 - a) * (1 - a) * front : 0;
    EXPECT_NEAR(of(102), a * front + far + through, 2e-3) << shape;
  }
}

TEST(Cutouts, AreSeenInMirrorsAndMirrorByTheirShare) {
  const auto scene = [](const std::string& mirror, const std::string& card) {
    return "camera { eye {} target { z: -1 } vertical_fov: 20 } light { name: 'l' direction { x: "
           "0.5 z: 1 } spectrum { standard: 'D65' } } material { name: 'mirror' mirror: 1 diffuse "
           "{ constant: 0 } " +
           mirror + " } material { name: 'card' diffuse { constant: 0.8 } " + card +
           " } object { name: 'm' material: 'mirror' quad { corner { x: -1 y: -1 z: -2 } u { x: 2 "
           "} v { y: 2 } } } object { name: 'c' material: 'card' quad { corner { x: -9 y: -9 z: 3 "
           "} u { x: 18 } v { y: 18 } } } settings { width: 4 height: 4 spp: 1 depth: 2 }";
  };
  const double whole = double{test::render(scene("", "")).at(2, 2)[1]};
  EXPECT_GT(whole, 0.1);
  EXPECT_NEAR(double{test::render(scene("", alpha), share(51)).at(2, 2)[1]}, 0.2 * whole, 1e-5);
  EXPECT_NEAR(double{test::render(scene(alpha, ""), share(51)).at(2, 2)[1]}, 0.2 * whole, 1e-5);
}

/// A label on glass takes its share of what is seen, and leaves the rest to the glass.
TEST(Cutouts, WhatLiesOnGlassIsALayerOfIt) {
  const auto scene = [](const std::string& label) {
    return "camera { eye { x: 0.3 y: 0.2 z: 5 } target {} vertical_fov: 20 } light { name: 'l' "
           "direction { x: 0.2 z: -1 } spectrum { standard: 'D65' } } material { name: 'glass' "
           "diffuse { constant: 0 } fresnel { dielectric { n { constant: 1.5 } } } transmission { "
           "} } material { name: 'label' diffuse { constant: 0.6 } alpha { file: 'a.png' } } "
           "material { name: 'wall' diffuse { constant: 0.5 } } object { name: 'w' material: "
           "'wall' quad { corner { x: -9 y: -9 z: -3 } u { x: 18 } v { y: 18 } } } "
           "object { name: 'g' material: 'glass' mesh { file: 'box.obj' } } " +
           label + " settings { width: 4 height: 4 spp: 1 depth: 8 }";
  };
  test::Files files = share(102);
  files["box.obj"] =
      "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"
      "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  const std::string label =
      "object { name: 'l' material: 'label' quad { corner { x: -1 y: -1 } u { x: 2 } v { y: 2 } } "
      "}";
  const auto y = [&](const std::string& text, int value) {
    files["a.png"] = share(static_cast<unsigned char>(value)).at("a.png");
    return double{test::render(scene(text), files).at(2, 1)[1]};
  };
  const double bare = y("", 0);
  EXPECT_NEAR(y(label, 0), bare, 1e-5);
  // The label alone, which its light reaches from outside.
  const double whole = y(label, 255);
  EXPECT_GT(whole, 0.3);
  EXPECT_GT(bare, 0.3);
  // What comes from behind has passed the label once as light, once as what is seen, but for what
  // the glass itself sends back and forth.
  EXPECT_NEAR(y(label, 102), 0.4 * whole + 0.6 * 0.6 * bare, 0.05 * bare);
}

TEST(Cutouts, WhatIsWrongIsSaidWithItsField) {
  const auto said = [](const std::string& material, const test::Files& files) -> std::string {
    try {
      test::compile_text(sheet(material), files);
      return "";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
  const test::Files rgb{{"a.png", test::small_png(1, 1, 2, {'\1', '\2', '\3'})}};
  EXPECT_EQ(said(alpha, rgb),
            "material[1].alpha.channel: the file has 3 channels (R G B), 1 is needed: name those "
            "that are meant");
  EXPECT_EQ(said("alpha { file: 'a.png' channel: 'G' }", rgb), "");
  EXPECT_EQ(said("alpha { file: 'a.png' channel: 'A' }", rgb),
            "material[1].alpha.channel: the file has no channel \"A\"; did you mean \"R\"?");
  EXPECT_EQ(said("normal_map { file: 'a.png' }", share(1)),
            "material[1].normal_map.file: a normal map needs R, G and B: the file has no R");
  EXPECT_EQ(said(alpha, {{"a.png", "no picture"}}),
            "material[1].alpha.file: can't read the picture: Not a PNG file");
}

}  // namespace
}  // namespace metamer
