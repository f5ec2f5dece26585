#include <algorithm>
#include <cmath>

#include "common/mesh/mesh_file.h"
#include "common/mesh/parts.h"
#include "common/mesh/smooth_normals.h"
#include "common/mesh/used_vertices.h"

namespace metamer {
namespace {

/// That all of a file is taken for one material.
std::optional<std::string> many_materials(const std::vector<MeshPiece>& pieces) {
  std::vector<std::string> names;
  for (const MeshPiece& piece : pieces)
    if (std::find(names.begin(), names.end(), piece.material) == names.end() && names.size() < 100)
      names.push_back(piece.material);
  if (names.size() < 2) return std::nullopt;
  std::string list;
  for (std::size_t i = 0; i < std::min<std::size_t>(names.size(), 6); ++i)
    list +=
        (i > 0 ? ", " : "") + (names[i].empty() ? std::string("none") : metamer::quoted(names[i]));
  if (names.size() > 6) list += " and more";
  return "its materials (" + list + ") are all the object's; a part has its own";
}

/// UVs for textures: where the file has none at some vertices, they are 0 there, and that is said.
std::vector<Float2> whole_uvs(MeshFile& file) {
  std::size_t missing = 0;
  for (Float2& uv : file.uvs) {
    if (!std::isnan(uv[0])) continue;
    uv = {0, 0};
    ++missing;
  }
  if (missing > 0)
    file.notes.push_back(std::to_string(missing) + " of " + std::to_string(file.uvs.size()) +
                         " vertices have no UVs; they are 0, 0 there");
  return std::move(file.uvs);
}

}  // namespace

Result<TriangleMesh> triangles_of(MeshFile file, const MeshUse& use) {
  if (use.part.empty()) {
    if (auto note = many_materials(file.pieces)) file.notes.push_back(*std::move(note));
  } else if (auto selected = select_part(file, use.part); !selected) {
    return tl::unexpected(selected.error());
  }
  join_repeated_vertices(file);
  auto crease_angle = use.crease_angle ? use.crease_angle : file.crease_angle;
  if (use.crease_angle) file.smoothing.clear();
  if (!file.smoothing.empty() && !crease_angle) crease_angle = 180;  // The groups alone count.
  if (file.normals.empty() && crease_angle)
    creased_normals(file, *crease_angle);
  else
    smooth_normals(file);
  TriangleMesh mesh;
  if (use.tangents) mesh.tangents = tangents_of(file);
  if (use.uvs) mesh.uvs = whole_uvs(file);
  if (file.positions_f64.empty())
    mesh.positions = Array<Float3>(std::move(file.positions));
  else
    mesh.positions = Array<Double3>(std::move(file.positions_f64));
  mesh.normals = std::move(file.normals);
  mesh.triangles = std::move(file.triangles);
  mesh.skipped_faces = file.skipped_faces;
  mesh.notes = std::move(file.notes);
  return mesh;
}

}  // namespace metamer
