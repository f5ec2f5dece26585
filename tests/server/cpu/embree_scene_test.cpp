#include "server/cpu/embree_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "server/cpu/shared_source.h"
#include "server/scene/camera_space.h"
#include "tests/server/test_scene.h"

namespace metamer::cpu {
namespace {

const std::atomic<bool> never = false;

RenderScene unit_ball() {
  return test::compile_text(
      "camera { eye { z: 5 } target {} } light { name: 'l' position { y: 3 } spectrum { standard: "
      "'E' } } "
      "material { name: 'm' diffuse { constant: 1 } } object { name: 'o' material: 'm' sphere { "
      "radius: "
      "1 } }");
}

TEST(EmbreeScene, RaysThatAreNotFiniteNeverReachEmbree) {
  // Debian's Embree is built with assertions: any of these would end the process.
  const RenderScene scene = unit_ball();
  const auto geometry = EmbreeScene::build(scene, never);
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = INFINITY, far = 1e30f;
  Vectors origin = broadcast({0, 0, 5}), direction = broadcast({0, 0, -1});
  origin.x[0] = nan, origin.y[1] = inf, origin.z[2] = far;
  direction.x[3] = nan, direction.y[4] = -inf, direction.z[5] = nan;
  const Hits hits = geometry->intersect(origin, direction, Ints{} - 1);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(hits.hit[i], 0) << i;
  EXPECT_EQ(hits.hit[6], -1);

  Floats length = broadcast(10);
  length[6] = nan;
  const Ints visible = geometry->visible(origin, direction * broadcast(-1), length, Ints{} - 1);
  for (int i = 0; i < 7; ++i) EXPECT_EQ(visible[i], 0) << i;
  EXPECT_EQ(visible[7], -1);
}

TEST(EmbreeScene, ASphereIsHitWhereTheQuadraticSays) {
  const RenderScene scene = unit_ball();
  const auto geometry = EmbreeScene::build(scene, never);
  Vectors origin = broadcast({0, 0, 5}), direction = broadcast({0, 0, -1});
  for (int i = 0; i < lane_count; ++i) origin.x[i] = 0.14f * static_cast<float>(i);
  const Hits hits = geometry->intersect(origin, direction, Ints{} - 1);
  for (int i = 0; i < lane_count; ++i) {
    const double x = origin.x[i], z = std::sqrt(1 - x * x);
    EXPECT_EQ(hits.hit[i], -1);
    EXPECT_NEAR(hits.distance[i], 5 - z, 2e-6);
    EXPECT_NEAR(hits.normal.x[i], x, 2e-6);
    EXPECT_NEAR(hits.normal.z[i], z, 2e-6);
  }
}

TEST(EmbreeScene, AnInstanceIsWhereItsTransformPutsIt) {
  // The same mesh twice becomes two instances; alone, each is placed. Both must agree.
  RenderScene pair = unit_ball();
  TriangleMesh mesh;
  mesh.positions = Array(std::vector<Float3>{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}});
  mesh.normals = std::vector<Float3>{{-0.6f, 0, 0.8f}, {0.6f, 0, 0.8f}, {0, 0, 1}};
  mesh.triangles = std::vector<Triangle>{{0, 1, 2}};
  pair.meshes = {mesh};
  Eigen::Affine3d place = Eigen::Translation3d(0.3, 0.2, 1) *
                          Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, 3).normalized()) *
                          Eigen::Scaling(1.0, 2.0, 3.0);
  pair.objects = {{"a", RenderObject::Shape::mesh, 0, 0, v1::PHONG, place},
                  {"b", RenderObject::Shape::mesh, 0, 0, v1::PHONG,
                   Eigen::Affine3d(Eigen::Translation3d(9, 9, 9))}};
  RenderScene alone = pair;
  alone.objects.pop_back();

  Vectors origin = broadcast({0.3f, 0.2f, 9}), direction = broadcast({0, 0, -1});
  for (int i = 0; i < lane_count; ++i) origin.x[i] += 0.05f * static_cast<float>(i);
  const Hits a = EmbreeScene::build(pair, never)->intersect(origin, direction, Ints{} - 1);
  const Hits b = EmbreeScene::build(alone, never)->intersect(origin, direction, Ints{} - 1);
  for (int i = 0; i < lane_count; ++i) {
    ASSERT_EQ(a.hit[i], -1);
    ASSERT_EQ(b.hit[i], -1);
    EXPECT_NEAR(a.distance[i], b.distance[i], 1e-5);
    EXPECT_NEAR(a.normal.x[i], b.normal.x[i], 1e-5);
    EXPECT_NEAR(a.normal.y[i], b.normal.y[i], 1e-5);
    EXPECT_NEAR(a.geometric_normal.x[i], b.geometric_normal.x[i], 1e-5);
  }
}

/// Every ray of a small picture of one object before a wall, in camera space.
std::size_t hits_of(const std::string& object) {
  const RenderScene scene = to_camera_space(test::compile_text(
      "camera { eye { z: 3 } target {} } light { name: 'l' position { y: 3 } spectrum { standard: "
      "'E' } } material { name: 'm' diffuse { constant: 1 } } object { name: 'wall' material: 'm' "
      "quad { corner { x: -9 y: -9 z: -9 } u { x: 18 } v { y: 18 } } } object { name: 'o' "
      "material: 'm' " +
      object + " }"));
  const auto geometry = EmbreeScene::build(scene, never);
  std::size_t count = 0;
  for (int y = -8; y <= 8; ++y) {
    Vectors direction = broadcast({0, static_cast<float>(y) / 20, -1});
    for (int x = 0; x < lane_count; ++x) direction.x[x] = static_cast<float>(x - 4) / 20;
    const Hits hits =
        geometry->intersect(broadcast({0, 0, 0}), shared::unit(direction), Ints{} - 1);
    for (int i = 0; i < lane_count; ++i) count += hits.hit[i] && hits.object[i] == 1 ? 1 : 0;
    geometry->visible(broadcast({0, 0, -1}), shared::unit(direction), broadcast(9), Ints{} - 1);
  }
  return count;
}

TEST(EmbreeScene, SpheresAndEllipsoidsOfAnySizeAreBuiltAndTraced) {
  // Embree's assertions would end the process where a size squared or its inverse leaves f32.
  const std::string flat = "transform { scale { x: 1 y: 1 z: 1e-3 } }";
  for (const std::string radius : {"1e-5", "1e-15", "1e-20", "1e-38", "1e-45", "1e-160", "5e-324"})
    EXPECT_LE(hits_of("sphere { radius: " + radius + " }"), 1u) << radius;
  for (const std::string radius : {"1e-5", "1e-15", "1e-20", "1e-38", "1e-45", "1e-160"})
    EXPECT_LE(hits_of("sphere { radius: " + radius + " } " + flat), 1u) << radius;
  for (const std::string far : {"", "1e5", "1e14"})  // however far the scene's end is
    EXPECT_GT(hits_of("sphere { radius: 1 } " + flat + " } object { name: 'far' material: 'm' " +
                      "sphere { center { y: " + (far.empty() ? "9" : far) + " } radius: 1 }"),
              20u)
        << far;
  for (const std::string extreme : {"x: 1 y: 1 z: 1e-14", "x: 1e-14 y: 1 z: 1", "x: 1 y: 1 z: 1e13",
                                    "x: 1e-14 y: 1e-14 z: 2e-14"})
    hits_of("sphere { radius: 1 } transform { scale { " + extreme + " } }");
}

TEST(EmbreeScene, ACancelledBuildGivesNothing) {
  const std::atomic<bool> at_once = true;
  const RenderScene scene = unit_ball();
  EXPECT_FALSE(EmbreeScene::build(scene, at_once).has_value());
}

}  // namespace
}  // namespace metamer::cpu
