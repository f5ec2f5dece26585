#include <cmath>

#include "../mesh_text.h"

namespace metamer {
namespace {

const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TriangleMesh with_tangents(const std::string& text) {
  return used(obj_of(text), {.tangents = true});
}

TEST(Tangents, PointTowardsRisingU) {
  const double h = std::sqrt(0.5);
  const std::pair<std::string, Double3> cases[] = {
      {"vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n", {1, 0, 0}},
      {"vt 0 0\nvt 0 1\nvt 1 1\nvt 1 0\n", {0, 1, 0}},
      {"vt 1 0\nvt 0 0\nvt 0 1\nvt 1 1\n", {-1, 0, 0}},
      {"vt 0 0\nvt 1 -1\nvt 2 0\nvt 1 1\n", {h, h, 0}},
      {"vt 5 5\nvt 5.001 5\nvt 5.001 9\nvt 5 9\n", {1, 0, 0}},
  };
  for (const auto& [uvs, direction] : cases) {
    const TriangleMesh mesh = with_tangents(vertices + uvs + "f 1/1 2/2 3/3 4/4\n");
    ASSERT_EQ(mesh.tangents.size(), 4u) << uvs;
    for (const Float3& tangent : mesh.tangents)
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(tangent[k], direction[k], 1e-6) << uvs;
  }
}

TEST(Tangents, AreNowhereWithoutUvsThatSpanAnArea) {
  EXPECT_TRUE(with_tangents(vertices + "f 1 2 3 4\n").tangents.empty());
  EXPECT_TRUE(with_tangents(vertices + "vt 1 1\nf 1/1 2/1 3/1 4/1\n").tangents.empty());
  EXPECT_TRUE(with_tangents(vertices + "vt 0 0\nvt 1 1\nvt 2 2\nf 1/1 2/2 3/3\n").tangents.empty());
  EXPECT_TRUE(used(obj_of(vertices + "vt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n")).tangents.empty())
      << "not asked for";
  const TriangleMesh some = with_tangents(
      vertices + "vt 0 0\nvt 1 0\nvt 1 1\nv 5 5 5\nv 6 5 5\nv 6 6 5\nf 1/1 2/2 3/3\nf 5 6 7\n");
  ASSERT_EQ(some.tangents.size(), 6u);
  EXPECT_EQ(some.tangents[0], (Float3{1, 0, 0}));
  EXPECT_EQ(some.tangents[5], (Float3{0, 0, 0})) << "none there";
}

TEST(Tangents, AreAtRightAnglesToNormals) {
  const TriangleMesh mesh = with_tangents(
      vertices + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 1 0 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\n");
  for (const Float3& tangent : mesh.tangents) {
    EXPECT_NEAR(tangent[0], std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(tangent[2], -std::sqrt(0.5), 1e-6);
  }
}

}  // namespace
}  // namespace metamer
