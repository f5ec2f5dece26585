#include "server/scene/media.h"

#include <gtest/gtest.h>

#include "common/scene/limits.h"
#include "server/plan/plan.h"
#include "server/scene/camera_space.h"
#include "tests/server/test_scene.h"

namespace metamer::test {
namespace {

/// A cube from 0 to 1 as quads, counter-clockwise from outside.
const std::string vertices =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
const std::vector<std::string> faces = {"f 1 4 3 2\n", "f 5 6 7 8\n", "f 1 2 6 5\n",
                                        "f 2 3 7 6\n", "f 3 4 8 7\n", "f 4 1 5 8\n"};

std::string cube(const std::vector<std::string>& sides = faces) {
  std::string text = vertices;
  for (const std::string& side : sides) text += side;
  return text;
}

const std::string glass =
    "camera { eye { z: 9 } target {} } light { name: 'l' position { z: 9 } spectrum { standard: "
    "'D65' } } material { name: 'glass' fresnel { dielectric { medium: 'N-BK7' } } transmission {} "
    "} ";
const std::string box = "object { name: 'box' material: 'glass' mesh { file: 'cube.obj' } } ";

RenderScene with_mesh(const std::string& mesh, const std::string& objects = box) {
  return compile_text(glass + objects, {{"cube.obj", mesh}});
}

std::vector<std::string> notices(const RenderScene& scene) {
  const v1::Plan plan = make_plan(scene, v1::Settings(), {.threads = 1});
  std::vector<std::string> fields;
  for (const v1::Notice& notice : plan.notice())
    if (notice.message().find("is not closed") != std::string::npos)
      fields.push_back(notice.field());
  return fields;
}

TEST(Media, AnOpenMeshThatLetsLightThroughIsTold) {
  EXPECT_TRUE(notices(with_mesh(cube())).empty());
  std::vector<std::string> sides = faces;
  sides.pop_back();
  EXPECT_EQ(notices(with_mesh(cube(sides))), std::vector<std::string>{"object[0]"});
  // Open at both ends: its normals still sum to 0.
  sides.erase(sides.begin() + 3);
  EXPECT_EQ(notices(with_mesh(cube(sides))), std::vector<std::string>{"object[0]"});
  // One face is turned.
  sides = faces;
  sides[2] = "f 5 6 2 1\n";
  EXPECT_EQ(notices(with_mesh(cube(sides))), std::vector<std::string>{"object[0]"});
  // A face with vertices of its own closes it all the same.
  sides = faces;
  sides[0] = "v 0 0 -0\nv 0 1 0\nv 1 1 0\nv 1 0 0\nf -4 -3 -2 -1\n";
  EXPECT_TRUE(notices(with_mesh(cube(sides))).empty());
  EXPECT_EQ(notices(compile_text(glass + "object { name: 'pane' material: 'glass' quad { u { x: 1 "
                                         "} v { y: 1 } } }")),
            std::vector<std::string>{"object[0]"});
}

TEST(Media, APointLiesInWhatIsWoundAroundIt) {
  const RenderScene scene = with_mesh(
      cube(),
      box +
          "object { name: 'flipped' material: 'glass' mesh { file: 'cube.obj' } transform { "
          "scale { x: -2 y: 1 z: 1 } } } object { name: 'ball' material: 'glass' sphere { "
          "center { x: 5 } radius: 2 } }");
  EXPECT_FALSE(is_turned_inwards(scene.meshes[0]));
  const auto around = [&](double x, double y, double z) {
    std::vector<int> all;
    for (const RenderObject& object : scene.objects)
      all.push_back(windings(scene, object, {x, y, z}));
    return all;
  };
  EXPECT_EQ(around(0.5, 0.5, 0.5), (std::vector<int>{1, 0, 0}));
  EXPECT_EQ(around(-1.5, 0.5, 0.5), (std::vector<int>{0, 1, 0}));
  EXPECT_EQ(around(5, 1.9, 0), (std::vector<int>{0, 0, 1}));
  EXPECT_EQ(around(1.01, 0.5, 0.5), (std::vector<int>{0, 0, 0}));
}

TEST(Media, WhatIsNearASurfaceIsFound) {
  const RenderScene scene = with_mesh(
      cube(),
      box + "object { name: 'ball' material: 'glass' sphere { center { x: 5 } radius: 2 } }");
  const auto near = [&](std::size_t object, const Eigen::Vector3d& point) {
    return is_near(scene, scene.objects[object], point, 1e-6);
  };
  for (const double side : {-1.0, 1.0}) {
    EXPECT_TRUE(near(0, {0.3, 0.4, 1 + side * 5e-7}));
    EXPECT_FALSE(near(0, {0.3, 0.4, 1 + side * 2e-6}));
    EXPECT_TRUE(near(1, {5, 2 + side * 5e-7, 0}));
    EXPECT_FALSE(near(1, {5, 2 + side * 2e-6, 0}));
  }
  EXPECT_TRUE(near(0, {1 + 5e-7, 1 + 5e-7, 0.5})) << "beyond an edge";
  EXPECT_FALSE(near(0, {1 + 9e-7, 1 + 9e-7, 0.5}));
  EXPECT_FALSE(near(0, {0.5, 0.5, 0.5}));
}

TEST(Media, AnEyeAtAClearSurfaceIsTold) {
  const auto told = [](const std::string& z) {
    const RenderScene scene = to_camera_space(compile_text(
        "camera { eye { z: " + z +
        " } target { z: -9 } } light { name: 'l' position { z: 9 } "
        "spectrum { standard: 'D65' } } material { name: 'glass' fresnel { dielectric { medium: "
        "'N-BK7' } } transmission {} } object { name: 'ball' material: 'glass' sphere { radius: 1 "
        "} }"));
    std::string fields;
    const v1::Plan plan = make_plan(scene, v1::Settings(), {.threads = 1});
    for (const v1::Notice& notice : plan.notice())
      if (notice.message().find("millionth") != std::string::npos) fields += notice.field();
    return fields;
  };
  EXPECT_EQ(told("1.0000001"), "camera.eye");
  EXPECT_EQ(told("0.9999999"), "camera.eye");
  EXPECT_EQ(told("1.00001"), "");
}

TEST(Media, InterfacesAreThoseOfMaterialsThatMayTouch) {
  const std::string more =
      "material { name: 'water' fresnel { dielectric { n { constant: 1.33 } } } transmission {} } "
      "material { name: 'gas' fresnel { dielectric { n { constant: 0.9 } } } transmission {} } "
      "material { name: 'unused' fresnel { dielectric { medium: 'diamond' } } transmission {} } ";
  const auto ball = [](const std::string& material, double x) {
    return "object { name: '" + material + "' material: '" + material +
           "' sphere { center { x: " + std::to_string(x) + " } radius: 1 } } ";
  };
  const RenderScene scene =
      compile_text(glass + more + ball("glass", 0) + ball("water", 1.5) + ball("gas", 9));
  ASSERT_EQ(scene.media.size(), 5u);  // with air
  ASSERT_EQ(scene.interfaces.size(), 4u);
  for (const RenderInterface& one : scene.interfaces)
    EXPECT_LE(scene.media[one.rare].index, scene.media[one.dense].index);
  // Glass in water: n of the one by that of the other.
  const auto touching =
      std::find_if(scene.interfaces.begin(), scene.interfaces.end(),
                   [](const auto& one) { return one.rare != 0 && one.dense != 0; });
  EXPECT_NEAR(index_at_d_line(scene.constants[touching->constants].n), 1.5168 / 1.33, 1e-5);
  const auto bubble = std::find_if(scene.interfaces.begin(), scene.interfaces.end(),
                                   [](const auto& one) { return one.dense == 0; });
  EXPECT_NEAR(index_at_d_line(scene.constants[bubble->constants].n), 1 / 0.9, 1e-12);
}

TEST(Media, TooManyThatTouchAreAnError) {
  std::string text = glass;
  for (int i = 0; i < 11; ++i) {
    const std::string name = "m" + std::to_string(i);
    text += "material { name: '" + name +
            "' fresnel { dielectric { n { constant: 1.4 } } } transmission {} } object { name: '" +
            name + "' material: '" + name + "' sphere { radius: 1 } } ";
  }
  try {
    compile_text(text);
    FAIL() << "it was compiled";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "material[0].transmission: clear materials touch in 66 pairs, each one's with air "
                 "among them; at most 64 are allowed");
  }
}

}  // namespace
}  // namespace metamer::test
