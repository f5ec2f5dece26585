#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include "common/mesh/mesh_file.h"
#include "common/mesh/obj/obj_mesh.h"
#include "common/mesh/ply/ply_mesh.h"

namespace metamer {

/// A text as a file's bytes.
inline Bytes bytes_of(const std::string& text) {
  return std::vector<char>(text.begin(), text.end());
}
inline Result<MeshFile> ply_of(const std::string& text) {
  return read_ply(bytes_of(text), "a.ply");
}
inline Result<MeshFile> obj_of(const std::string& text) {
  return read_obj(bytes_of(text), "a.obj");
}
/// What a person reads of a file's problem; "" where it has none.
inline std::string problem_of(const Result<MeshFile>& file) {
  return file ? "" : format(file.error());
}

/// A file of tests/common/mesh/cases.
inline std::string case_text(const std::string& name) {
  std::ifstream from(METAMER_TEST_DATA "/common/mesh/cases/" + name, std::ios::binary);
  EXPECT_TRUE(from) << name;
  return {std::istreambuf_iterator<char>(from), std::istreambuf_iterator<char>()};
}

/// A file's triangles, used as a whole.
inline TriangleMesh used(const Result<MeshFile>& file, const MeshUse& use = {}) {
  if (!file) {
    ADD_FAILURE() << format(file.error());
    return {};
  }
  auto mesh = triangles_of(*file, use);
  if (!mesh) ADD_FAILURE() << format(mesh.error());
  return mesh.value_or(TriangleMesh());
}

/// The corners of all triangles, by their positions: what a file draws, however it numbers them.
inline std::vector<Double3> corners_of(const TriangleMesh& mesh) {
  std::vector<Double3> corners;
  for (const Triangle& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle) corners.push_back(mesh.positions[vertex]);
  return corners;
}

/// The corners of the square whose vertices are (0 0 0), (1 0 0), (1 1 0), (0 1 0), in two
/// triangles.
inline std::vector<Double3> square_corners() {
  return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
}

/// Reads a file with each byte in turn changed, cut off or put in twice: all end in a mesh that can
/// be used, or in a problem that says something.
template <typename Read>
void expect_no_byte_breaks(const std::string& text, const Read& read) {
  const auto look = [&](const std::string& other) {
    const Result<MeshFile> file = read(other);
    if (!file) {
      EXPECT_FALSE(file.error().message.empty());
    } else {
      EXPECT_FALSE(file->triangles.empty());
      for (const Triangle& triangle : file->triangles)
        for (const std::uint32_t vertex : triangle)
          ASSERT_LT(vertex, file->positions.size() + file->positions_f64.size());
      EXPECT_TRUE(triangles_of(*file, {.crease_angle = 30, .tangents = true}));
    }
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    for (const char byte : {'\0', '\x7f', '\xff', '-', '9', '\n', ' ', '\\', '/'}) {
      std::string other = text;
      other[i] = byte;
      look(other);
    }
    look(text.substr(0, i));
    look(text.substr(0, i) + text.substr(i + 1));
    look(text.substr(0, i) + text[i] + text.substr(i));
  }
}

/// The angle between two unit vectors in degrees.
inline double degrees_between(const Float3& a, const Float3& b) {
  double cosine = 0, sine = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
    cosine += double{a[k]} * b[k];
    const double part = double{a[u]} * b[v] - double{a[v]} * b[u];
    sine += part * part;
  }
  return std::atan2(std::sqrt(sine), cosine) * 180 / M_PI;
}

}  // namespace metamer
