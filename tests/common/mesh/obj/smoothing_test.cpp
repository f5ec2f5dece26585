#include <cmath>

#include "../mesh_text.h"

namespace metamer {
namespace {

/// Three squares about the y axis, each at right angles to the one before: up, right, down.
const std::string channel =
    "v 0 0 0\nv 0 1 0\nv 0 1 1\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 1 0 0\nv 1 1 0\n";
const std::string up = "f 1 4 3 2\n", right = "f 4 5 6 3\n", down = "f 5 7 8 6\n";

/// The angle in degrees that the normal at a corner of a square has with the square's own, by the
/// square's first triangle: at its corners on the edges to its neighbours.
std::string angles(const std::string& text, const MeshUse& use = {}) {
  const TriangleMesh mesh = used(obj_of(channel + text), use);
  std::string result;
  for (std::size_t i = 0; i + 1 < mesh.triangles.size(); i += 2) {
    const Triangle& t = mesh.triangles[i];
    const auto at = [&](std::size_t k) { return mesh.positions[t[k]]; };
    const Double3 a = at(0), b = at(1), c = at(2);
    Float3 plane{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
      plane[k] = static_cast<float>((b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]));
    }
    for (const std::uint32_t vertex : t)
      result += std::to_string(std::lround(degrees_between(mesh.normals[vertex], plane))) + " ";
  }
  return result;
}

// Wavefront's manual: faces of one group share normals; those of "off" or 0 share none.
TEST(Smoothing, IsWithinTheGroupsOfAFile) {
  const std::string round = "0 45 45 45 45 45 45 0 0 ";
  const std::string flat = "0 0 0 0 0 0 0 0 0 ";
  EXPECT_EQ(angles(up + right + down), round) << "nothing said";
  EXPECT_EQ(angles("s 7\n" + up + right + down), round);
  EXPECT_EQ(angles("s off\n" + up + right + down), flat);
  EXPECT_EQ(angles("s 0\n" + up + "s off\n" + right + "s\n" + down), flat);
  EXPECT_EQ(angles("s 1\n" + up + "s 2\n" + right + "s 3\n" + down), flat);
  EXPECT_EQ(angles("s 1\n" + up + right + "s 2\n" + down), "0 45 45 45 0 0 0 0 0 ");
  EXPECT_EQ(angles("s 1\n" + up + right + "s off\n" + down), "0 45 45 45 0 0 0 0 0 ");
  EXPECT_EQ(angles(up + right + "s 4294967295\n" + down), round) << "the number of all before";
  EXPECT_EQ(angles("s 1\n" + up + "s 2\n" + right + "s 1\n" + down), flat) << "they share no edge";
}

TEST(Smoothing, GoesWithAPart) {
  const std::string text = "s 1\no a\n" + up + "o b\n" + right + "s 2\n" + down + "f 1 1 1\n";
  EXPECT_EQ(angles(text), "0 45 45 45 0 0 0 0 0 ");
  EXPECT_EQ(angles(text, {.part = "b"}), "0 0 0 0 0 0 ");
  EXPECT_EQ(angles("s 2\no a\n" + up + "s 1\no b\n" + right + down, {.part = "b"}),
            "0 45 45 45 0 0 ");
}

TEST(Smoothing, OfAFileGivesWayToAnAngleThatIsAskedFor) {
  EXPECT_EQ(angles("s off\n" + up + right + "s 1\n" + down, {.crease_angle = 180}),
            "0 45 45 45 45 45 45 0 0 ");
  EXPECT_EQ(angles("s 1\n" + up + right + "s 2\n" + down, {.crease_angle = 30}),
            "0 0 0 0 0 0 0 0 0 ");
}

TEST(Smoothing, IsKeptFromOnePieceOfALargeFileToTheNext) {
  std::string text = "s 5\n" + up;
  while (text.size() < (std::size_t{1} << 19)) text += "# of nothing, for many a line\n";
  const std::string far = text + right + "s 6\n" + down;
  EXPECT_EQ(angles(far), "0 45 45 45 0 0 0 0 0 ");
}

}  // namespace
}  // namespace metamer
