#include "tests/server/scene/import_one.h"

#include <gtest/gtest.h>

namespace metamer {
namespace {

/// A square in a .ply: with so many vertices, and two triangles of them.
Result<TriangleMesh> square(const std::string& vertices, int count, const std::string& faces) {
  const std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) +
                           "\nproperty float x\nproperty float y\nproperty float z\n"
                           "element face 2\nproperty list uchar int vertex_indices\nend_header\n" +
                           vertices + faces;
  return test::import_one("square.ply",
                          [&](const std::string&) -> Result<std::string> { return text; });
}

const std::string corners = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

TEST(MeshImport, VerticesThatAFileRepeatsForEachTriangleAreJoined) {
  const auto mesh = square("0 0 0\n1 0 0\n1 1 0\n0 0 0\n1 1 0\n0 1 0\n", 6, "3 0 1 2\n3 3 4 5\n");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->positions.size(), 4u);
  EXPECT_EQ(mesh->triangles.size(), 2u);
}

TEST(MeshImport, VerticesThatTrianglesShareStayAsTheyAre) {
  const auto mesh = square(corners, 4, "3 0 1 2\n3 0 2 3\n");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->positions.size(), 4u);
  ASSERT_EQ(mesh->normals.size(), 4u);
  for (const auto& normal : mesh->normals) EXPECT_FLOAT_EQ(normal[2], 1);
}

}  // namespace
}  // namespace metamer
