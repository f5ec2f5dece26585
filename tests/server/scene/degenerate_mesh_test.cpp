#include <gtest/gtest.h>

#include <limits>

#include "tests/server/scene/import_one.h"

// Faces and vertices that make no triangle, in each format: a mesh or a message, and never the end
// of the process, which draws other people's pictures, too.

namespace metamer {
namespace {

using Faces = std::vector<std::vector<std::int32_t>>;
using Vertices = std::vector<std::array<float, 3>>;

const Vertices unit_square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

enum class Format { ascii, little_endian, big_endian };
constexpr Format formats[] = {Format::ascii, Format::little_endian, Format::big_endian};

/// A number's bytes in the order of the format.
template <class T>
std::string bytes(T value, Format format) {
  std::string text(reinterpret_cast<const char*>(&value), sizeof value);
  if (format == Format::big_endian) std::reverse(text.begin(), text.end());
  return text;
}

std::string ply(const Vertices& vertices, const Faces& faces, Format format) {
  constexpr const char* names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
  std::string text = "ply\nformat " + std::string(names[static_cast<int>(format)]) +
                     " 1.0\nelement vertex " + std::to_string(vertices.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                     std::to_string(faces.size()) +
                     "\nproperty list uchar int vertex_indices\nend_header\n";
  const bool ascii = format == Format::ascii;
  for (const auto& vertex : vertices) {
    for (const float x : vertex) text += ascii ? std::to_string(x) + " " : bytes(x, format);
    if (ascii) text += "\n";
  }
  for (const auto& face : faces) {
    text += ascii ? std::to_string(face.size()) : std::string(1, static_cast<char>(face.size()));
    for (const std::int32_t i : face) text += ascii ? " " + std::to_string(i) : bytes(i, format);
    if (ascii) text += "\n";
  }
  return text;
}

Result<TriangleMesh> import_text(const std::string& name, const std::string& text) {
  return test::import_one(name, [&](const std::string&) -> Result<std::string> { return text; });
}

TEST(DegenerateMesh, AFaceOfAPlyWithFewerThanThreeCornersIsSkippedAndCounted) {
  struct Case {
    Faces faces;
    std::size_t triangles;
    std::uint64_t skipped;
  };
  const std::vector<Case> cases = {
      {{{}, {0, 1, 2}}, 1, 1},        {{{0, 1, 2}, {}}, 1, 1},
      {{{3}, {0, 1, 2}}, 1, 1},       {{{2, 3}, {0, 1, 2}}, 1, 1},
      {{{0, 0, 0}, {0, 1, 2}}, 2, 0}, {{{}, {0}, {0, 1}, {0, 1, 2}, {0, 1, 2, 3}}, 3, 3}};
  for (const Format format : formats)
    for (const Case& one : cases) {
      const auto mesh = import_text("x.ply", ply(unit_square, one.faces, format));
      ASSERT_TRUE(mesh) << mesh.error().message;
      EXPECT_EQ(mesh->triangles.size(), one.triangles);
      EXPECT_EQ(mesh->skipped_faces, one.skipped);
      for (const auto& triangle : mesh->triangles) {
        if (triangle[0] == triangle[1])
          continue;  // without area; those beside it keep their normals
        for (const auto i : triangle) EXPECT_FLOAT_EQ(mesh->normals[i][2], 1);
      }
    }
}

TEST(DegenerateMesh, APlyWithoutTrianglesOrWithABadVertexHasItsMessage) {
  const float infinity = std::numeric_limits<float>::infinity();
  const auto with = [](float x) {
    Vertices vertices = unit_square;
    vertices[3][0] = x;
    return vertices;
  };
  const std::string empty = "holds no triangles", far = "vertex 3 is not finite or too far out";
  struct Case {
    Vertices vertices;
    Faces faces;
    std::string message;
  };
  const std::vector<Case> cases = {
      {unit_square, {}, empty},
      {unit_square, {{}}, empty},
      {unit_square, {{0}}, empty},
      {unit_square, {{0, 1}, {}}, empty},
      {unit_square, {{0, 1, 9}}, "face 0 names vertex 9; there are 4"},
      {unit_square, {{0, 9}, {0, 1, 2}}, "face 0 names vertex 9; there are 4"},
      {unit_square, {{0, 1, -1}}, "face 0 names vertex 4294967295; there are 4"},
      {with(infinity), {{0, 1, 2}}, far},
      {with(-infinity), {{0, 1, 2}}, far},
      {with(std::numeric_limits<float>::quiet_NaN()), {{0, 1, 2}}, far},
      {with(1e16f), {{0, 1, 2}}, far},
      {{},
       {{0, 1, 2}},
       "can't be read as a mesh: Invalid .ply file: Vertices should be declared before faces"}};
  for (const Format format : formats)
    for (const Case& one : cases) {
      const auto mesh = import_text("x.ply", ply(one.vertices, one.faces, format));
      ASSERT_FALSE(mesh) << one.message;
      EXPECT_EQ(mesh.error().message, one.message);
    }
}

TEST(DegenerateMesh, AnObjMayMixPointsAndLinesWithTriangles) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  for (const std::string rest : {"f 1 2 3\n", "f 1\nf 1 2 3\n", "f 1 2\nf 1 2 3\n",
                                 "p 1\nf 1 2 3\n", "g a\np 1\ng b\nf 1 2 3\ng c\nl 1 2\n"}) {
    const auto mesh = import_text("x.obj", vertices + rest);
    ASSERT_TRUE(mesh) << rest << mesh.error().message;
    EXPECT_EQ(mesh->triangles.size(), 1u) << rest;
  }
  for (const std::string rest : {"f 1\n", "p 1 2\n", "l 1 2 3\n", "f 1 2 9\n", "f 0 1 2\n",
                                 "v 1e38 0 0\nf 1 2 5\n", "v nan nan nan\nf 1 2 5\n"})
    EXPECT_FALSE(import_text("x.obj", vertices + rest)) << rest;
}

TEST(DegenerateMesh, AGltfThatDrawsNoTrianglesOrMovesThemTooFarHasItsMessage) {
  const auto gltf = [](int mode, const std::string& node) {
    std::string text = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
      "nodes":[{"mesh":0)" +
                       node + R"(}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":)" +
                       std::to_string(mode) + R"(}]}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
                    "min":[0,0,0],"max":[1,1,0]}],
      "bufferViews":[{"buffer":0,"byteLength":36}],
      "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)";
    // (0, 0, 0), (1, 0, 0), (0, 1, 0) as f32.
    return text + "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}";
  };
  for (const int triangles : {4, 5, 6}) EXPECT_TRUE(import_text("x.gltf", gltf(triangles, "")));
  for (const int others : {0, 1, 2, 3, 7}) {
    const auto mesh = import_text("x.gltf", gltf(others, ""));
    ASSERT_FALSE(mesh) << others;
    EXPECT_EQ(mesh.error().message, "holds no triangles") << others;
  }
  for (const std::string node : {R"(,"scale":[1e38,1e38,1e38])", R"(,"scale":[1e300,1,1])",
                                 R"(,"translation":[0,1e20,0])"}) {
    const auto mesh = import_text("x.gltf", gltf(4, node));
    ASSERT_FALSE(mesh) << node;
    EXPECT_EQ(mesh.error().message,
              "moves a vertex by its own nodes to where it is not finite or too far out");
  }
  for (const std::string node : {R"(,"scale":[0,0,0])", R"(,"scale":[1e-44,1,1])"})
    EXPECT_TRUE(import_text("x.gltf", gltf(4, node))) << node;
}

TEST(DegenerateMesh, AFileIsReadByTheReaderOfItsExtensionAlone) {
  // Assimp would take this for a .x file.
  EXPECT_FALSE(import_text("x.gltf", "xof 0303txt 0032\n"));
  EXPECT_FALSE(import_text("x.ply", "solid a\nfacet normal 0 0 1\nendsolid\n"));
}

}  // namespace
}  // namespace metamer
