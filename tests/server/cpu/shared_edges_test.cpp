// No ray passes between triangles that share an edge or a corner.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "server/cpu/embree_scene.h"
#include "server/scene/placement.h"
#include "tests/server/test_scene.h"

namespace metamer::cpu {
namespace {

using Eigen::Vector3d;

struct EdgeSolid {
  std::vector<Float3> corners;
  std::vector<Triangle> triangles;  ///< Counter-clockwise, seen from outside.

  std::uint32_t add(double x, double y, double z) {
    corners.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
    return static_cast<std::uint32_t>(corners.size() - 1);
  }
  void add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  }
};

EdgeSolid box_solid() {
  EdgeSolid solid;
  for (const double z : {-0.7, 0.9})
    for (const double y : {-1.1, 0.6})
      for (const double x : {-0.8, 1.3}) solid.add(x, y, z);
  solid.add_quad(0, 2, 3, 1);
  solid.add_quad(4, 5, 7, 6);
  solid.add_quad(0, 1, 5, 4);
  solid.add_quad(2, 6, 7, 3);
  solid.add_quad(0, 4, 6, 2);
  solid.add_quad(1, 3, 7, 5);
  return solid;
}

/// Rings of so many corners, by their radii and heights, between two tips.
EdgeSolid turned(std::uint32_t around, const std::vector<std::pair<double, double>>& rings,
                 double low, double high) {
  EdgeSolid solid;
  const std::uint32_t bottom = solid.add(0.01, low, 0.02), top = solid.add(0.03, high, -0.01);
  const auto at = [&](std::size_t ring, std::uint32_t i) {
    return 2 + static_cast<std::uint32_t>(ring) * around + i % around;
  };
  for (const auto& [radius, height] : rings)
    for (std::uint32_t i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around + 0.1;
      solid.add(radius * std::cos(angle), height, -radius * std::sin(angle));
    }
  for (std::uint32_t i = 0; i < around; ++i) {
    solid.triangles.push_back({bottom, at(0, i + 1), at(0, i)});
    solid.triangles.push_back({top, at(rings.size() - 1, i), at(rings.size() - 1, i + 1)});
    for (std::size_t ring = 0; ring + 1 < rings.size(); ++ring)
      solid.add_quad(at(ring, i), at(ring, i + 1), at(ring + 1, i + 1), at(ring + 1, i));
  }
  return solid;
}

EdgeSolid cylinder_solid() { return turned(32, {{1, -1}, {1, 1}}, -1, 1); }

EdgeSolid sphere_solid() {
  std::vector<std::pair<double, double>> rings;
  for (int i = 1; i < 16; ++i) {
    const double angle = std::numbers::pi * i / 16;
    rings.emplace_back(std::sin(angle), -std::cos(angle));
  }
  return turned(24, rings, -1, 1);
}

RenderScene scene_of_solid(const EdgeSolid& solid) {
  RenderScene scene = test::compile_text(
      "camera { eye { z: 5 } target {} } light { name: 'l' position { y: 3 } spectrum { standard: "
      "'E' } } material { name: 'm' fresnel { dielectric { medium: 'water' } } transmission {} } "
      "object { name: 'o' material: 'm' sphere { radius: 1 } }");
  TriangleMesh mesh;
  mesh.positions = Array(solid.corners);
  mesh.triangles = solid.triangles;
  scene.meshes = {mesh};
  scene.objects = {
      {"solid", RenderObject::Shape::mesh, 0, 0, v1::PHONG, Eigen::Affine3d::Identity()}};
  return scene;
}

/// Of rays that are aimed at edges and corners all of whose triangles face them, how many meet
/// anything but these, or nothing.
std::size_t leaks_of(const EdgeSolid& solid, std::size_t rays) {
  const RenderScene scene = scene_of_solid(solid);
  const auto geometry = EmbreeScene::build(scene, std::atomic<bool>(false));
  std::vector<Vector3d> corners;
  for (const Float3& corner : solid.corners) corners.push_back(to_vector(corner));
  std::vector<std::vector<Vector3d>> normals(corners.size());  // around each corner
  for (const Triangle& t : solid.triangles) {
    const Vector3d a = corners[t[0]], b = corners[t[1]], c = corners[t[2]];
    for (const std::uint32_t i : t) normals[i].push_back((b - a).cross(c - a).normalized());
  }
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  std::normal_distribution<double> normal;
  const auto faces = [&](std::uint32_t corner, const Vector3d& from, const Vector3d& to) {
    const Vector3d way = (from - to).normalized();
    return std::all_of(normals[corner].begin(), normals[corner].end(),
                       [&](const Vector3d& n) { return n.dot(way) > 0.02; });
  };
  std::size_t leaks = 0;
  for (std::size_t done = 0; done < rays; done += lane_count) {
    Vectors origin{}, direction{};
    Floats distance{};
    for (int lane = 0; lane < lane_count;) {
      const Triangle& t = solid.triangles[random() % solid.triangles.size()];
      const std::size_t side = random() % 3;
      const std::uint32_t a = t[side], b = t[(side + 1) % 3];
      const double along = random() % 8 == 0 ? 0 : share(random);  // or at the corner itself
      const Vector3d to = corners[a] + along * (corners[b] - corners[a]);
      const Vector3d from = Vector3d(normal(random), normal(random), normal(random)).normalized() *
                            (3 + 5 * share(random));
      if (!faces(a, from, to) || (along > 0 && !faces(b, from, to))) continue;
      const Vector3d way = (to - from).normalized();
      const auto f32 = [](double x) { return static_cast<float>(x); };
      origin.x[lane] = f32(from.x()), origin.y[lane] = f32(from.y()),
      origin.z[lane] = f32(from.z());
      direction.x[lane] = f32(way.x()), direction.y[lane] = f32(way.y()),
      direction.z[lane] = f32(way.z());
      distance[lane++] = f32((to - from).norm());
    }
    const Hits hits = geometry->intersect(origin, direction, Ints{} - 1);
    for (int lane = 0; lane < lane_count; ++lane)
      leaks += !hits.hit[lane] || std::abs(hits.distance[lane] - distance[lane]) > 1e-3f;
  }
  return leaks;
}

/// Within 1e-7 of an edge the sign of what rounds is anyone's guess: of such rays one in ten passes
/// without Embree's robust mode, one in a thousand with it.
TEST(SharedEdges, OfClearThingsLetNextToNoneOfTheRaysPassThatAreAimedAtThem) {
  EXPECT_LE(leaks_of(box_solid(), 8'000), 40u);
  EXPECT_LE(leaks_of(cylinder_solid(), 8'000), 40u);
  EXPECT_LE(leaks_of(sphere_solid(), 8'000), 40u);
}

}  // namespace
}  // namespace metamer::cpu
