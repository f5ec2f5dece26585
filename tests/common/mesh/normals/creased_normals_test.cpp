#include <algorithm>
#include <random>
#include <set>

#include "../mesh_text.h"

namespace metamer {
namespace {

/// A prism of so many sides around z, without ends, its vertices shared.
std::string prism(int sides) {
  std::string vertices, faces;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * M_PI * i / sides;
    for (const int z : {0, 1})
      vertices += "v " + number_text(std::cos(angle)) + " " + number_text(std::sin(angle)) + " " +
                  std::to_string(z) + "\n";
    const int a = 2 * i + 1, b = 2 * ((i + 1) % sides) + 1;
    faces += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(b + 1) +
             " " + std::to_string(a + 1) + "\n";
  }
  return vertices + faces;
}

TEST(CreasedNormals, AnEdgeStaysAboveTheAngleAlone) {
  // Neighbours of a hexagonal prism are 60° apart.
  const auto file = obj_of(prism(6));
  const TriangleMesh smooth = used(file, {.crease_angle = 61});
  EXPECT_EQ(smooth.positions.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) {
    const Double3 p = smooth.positions[i];
    const Float3 radial{static_cast<float>(p[0]), static_cast<float>(p[1]), 0};
    EXPECT_LT(degrees_between(smooth.normals[i], radial), 1e-3) << "as without an angle";
  }
  const TriangleMesh sharp = used(file, {.crease_angle = 59});
  EXPECT_EQ(sharp.positions.size(), 24u) << "each vertex once for each of its sides";
  for (const Triangle& t : sharp.triangles)
    for (const std::uint32_t vertex : t)
      EXPECT_LT(degrees_between(sharp.normals[vertex], sharp.normals[t[0]]), 1e-3) << "flat";
  EXPECT_EQ(corners_of(sharp), corners_of(smooth));
}

TEST(CreasedNormals, ACubeKeepsItsEdgesHoweverItsVerticesAreShared) {
  const std::string shared =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
      "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  for (const auto& file : {obj_of(shared), ply_of(case_text("good.ply"))}) {
    const TriangleMesh cube = used(file, {.crease_angle = 30});
    EXPECT_EQ(cube.positions.size(), 24u);
    for (const Float3& normal : cube.normals)
      EXPECT_EQ(std::count(normal.begin(), normal.end(), 0.0f), 2) << "along an axis";
  }
}

TEST(CreasedNormals, OneSideOfACreaseStaysSmoothWhereItRunsOut) {
  // A fold in a sheet of four squares: its crease ends in the middle vertex, whose triangles hang
  // together around its end.
  const auto file = obj_of(
      "v 0 0 0\nv 1 0 1\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nv 0 2 0\nv 1 2 0\nv 2 2 0\n"
      "f 1 2 5\nf 1 5 4\nf 2 3 5\nf 3 6 5\nf 4 5 8 7\nf 5 6 9 8\n");
  const TriangleMesh mesh = used(file, {.crease_angle = 60});
  std::set<Float3> at_middle;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (mesh.positions[i] == Double3{1, 1, 0}) at_middle.insert(mesh.normals[i]);
  EXPECT_EQ(at_middle.size(), 1u);
}

TEST(CreasedNormals, DependOnNoOrder) {
  const auto file = obj_of(prism(12));
  ASSERT_TRUE(file);
  const auto corners = [](const TriangleMesh& mesh) {
    std::set<std::pair<Double3, std::array<int, 3>>> set;  // Places with their normals, rounded.
    for (const Triangle& t : mesh.triangles)
      for (const std::uint32_t vertex : t) {
        std::array<int, 3> rounded{};
        for (std::size_t k = 0; k < 3; ++k)
          rounded[k] = static_cast<int>(std::lround(1e5 * mesh.normals[vertex][k]));
        set.insert({mesh.positions[vertex], rounded});
      }
    return set;
  };
  for (const double angle : {0.0, 29.0, 31.0, 180.0}) {
    const MeshUse use{.crease_angle = angle};
    const auto expected = corners(used(file, use));
    EXPECT_EQ(expected.size(), angle < 30 ? 48u : 24u);
    std::mt19937 random(1);
    for (int turn = 0; turn < 5; ++turn) {
      MeshFile other = *file;
      std::shuffle(other.triangles.begin(), other.triangles.end(), random);
      EXPECT_EQ(corners(used(other, use)), expected) << angle;
    }
  }
}

TEST(CreasedNormals, AFilesOwnNormalsStay) {
  const auto file = obj_of("v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 1 0\nf 1//1 2//1 3//1\n");
  EXPECT_EQ(used(file, {.crease_angle = 10}).normals[0], (Float3{0, 1, 0}));
}

}  // namespace
}  // namespace metamer
