// The readers of mesh files against any bytes.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "check.h"
#include "common/mesh/mesh_file.h"
#include "common/mesh/obj/materials.h"
#include "common/scene/limits.h"

namespace {

using metamer::fuzz::check;

bool unit_or_none(const metamer::Float3& v) {
  const double length = std::hypot(v[0], v[1], v[2]);
  return length == 0 || std::abs(length - 1) < 1e-5;
}

void check_file(const metamer::MeshFile& file) {
  const std::size_t vertices = file.positions.size() + file.positions_f64.size();
  check(file.positions.empty() || file.positions_f64.empty(), "positions are f32 or f64");
  check(file.normals.empty() || file.normals.size() == vertices, "each vertex has a normal");
  check(file.uvs.empty() || file.uvs.size() == vertices, "each vertex has a UV");
  check(std::all_of(file.normals.begin(), file.normals.end(), unit_or_none),
        "normals are unit or 0");
  check(!file.triangles.empty() && file.triangles.size() <= metamer::limits::max_triangles,
        "triangles are bounded");
  std::uint64_t in_pieces = 0;
  for (const metamer::MeshPiece& piece : file.pieces) {
    check(piece.first_triangle == in_pieces && piece.triangles > 0, "pieces lie in a row");
    in_pieces += piece.triangles;
  }
  check(in_pieces == file.triangles.size(), "each triangle is in a piece");
}

void check_mesh(const metamer::TriangleMesh& mesh) {
  const std::size_t vertices = mesh.positions.size();
  for (std::size_t i = 0; i < vertices; ++i)
    for (const double x : mesh.positions[i])
      check(std::abs(x) <= metamer::limits::max_coordinate, "positions are finite");
  for (const metamer::Triangle& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle)
      check(vertex < vertices, "triangles name vertices that are there");
  for (const auto* vectors : {&mesh.normals, &mesh.tangents}) {
    check(vectors->empty() || vectors->size() == vertices, "each vertex has a vector");
    check(std::all_of(vectors->begin(), vectors->end(), unit_or_none), "vectors are unit or 0");
  }
}

void check_materials(const metamer::MtlFile& file) {
  check(file.materials.size() <= metamer::max_mtl_names, "materials are bounded");
  for (const metamer::MtlMaterial& one : file.materials)
    for (const auto& color : {one.diffuse, one.specular})
      check(!color || std::all_of(color->begin(), color->end(),
                                  [](double value) { return std::isfinite(value); }),
            "colours are finite");
}

/// What a format's files begin with tells which is meant.
std::string name_of(std::string_view bytes) {
  if (bytes.starts_with("ply")) return "fuzz.ply";
  if (bytes.starts_with("glTF")) return "fuzz.glb";
  if (bytes.starts_with("{")) return "fuzz.gltf";
  return "fuzz.obj";
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto* const begin = reinterpret_cast<const char*>(data);
  check(metamer::mtl_names({begin, size}).size() <= metamer::max_mtl_files, "few files");
  check_materials(metamer::read_mtl({begin, size}));
  const std::string name = name_of({begin, size});
  const auto files = [&](const std::string& asked) -> metamer::Result<metamer::Bytes> {
    if (asked != name) return metamer::problem("is not there");
    return metamer::Bytes(std::vector<char>(begin, begin + size));
  };
  const auto file = metamer::read_mesh(name, files);
  if (!file) {
    check(!file.error().message.empty(), "a problem says something");
    check(file.error().line >= 0 && file.error().column >= 0, "a place counts from 1");
    return 0;
  }
  check_file(*file);
  std::vector<metamer::MeshUse> uses = {
      {.tangents = true}, {.crease_angle = 30}, {.part = file->pieces.front().material}};
  for (const metamer::MeshUse& use : uses)
    if (const auto mesh = metamer::triangles_of(*file, use)) check_mesh(*mesh);
  return 0;
}
