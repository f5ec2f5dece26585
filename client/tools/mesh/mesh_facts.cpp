#include "client/tools/mesh/mesh_facts.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include "client/tools/text/job_text.h"
#include "common/mesh/vertex.h"
#include "common/scene/files.h"
#include "common/scene/limits.h"

namespace metamer::client {
namespace {

std::string format_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".ply" ? "PLY" : extension == ".obj" ? "OBJ" : "glTF";
}

std::string both_names(const MeshPart& part) { return part.object + "/" + part.material; }

/// The names that choose a part, each once.
std::set<std::string> names_of(const MeshPart& part) {
  return {part.object, part.material, both_names(part)};
}

void name_parts(std::vector<MeshPart>& parts) {
  std::map<std::string, std::size_t> chosen;  // How many parts each name chooses.
  for (const MeshPart& part : parts)
    for (const std::string& name : names_of(part)) ++chosen[name];
  for (MeshPart& part : parts)
    for (const std::string& name : {part.material, part.object, both_names(part)})
      if (part.part.empty() && !name.empty() && chosen[name] == 1 && parts.size() > 1)
        part.part = name;
}

bool have_uvs(const MeshFile& mesh, const MeshPiece& piece) {
  const auto first = mesh.triangles.begin() + static_cast<std::ptrdiff_t>(piece.first_triangle);
  return !mesh.uvs.empty() &&
         std::all_of(first, first + static_cast<std::ptrdiff_t>(piece.triangles),
                     [&](const Triangle& triangle) {
                       return std::all_of(triangle.begin(), triangle.end(), [&](auto corner) {
                         return std::isfinite(mesh.uvs[corner][0]);
                       });
                     });
}

std::vector<MeshPart> parts_of(const MeshFile& mesh) {
  std::vector<MeshPart> parts;
  std::map<std::pair<std::string, std::string>, std::size_t> places;
  for (const MeshPiece& piece : mesh.pieces) {
    const auto [place, added] = places.try_emplace({piece.object, piece.material}, parts.size());
    if (added)
      parts.push_back(
          {.object = piece.object, .material = piece.material, .part = {}, .has_uvs = true});
    MeshPart& part = parts[place->second];
    part.triangles += piece.triangles;
    part.has_uvs = part.has_uvs && have_uvs(mesh, piece);
  }
  name_parts(parts);
  return parts;
}

}  // namespace

namespace {

/// A mesh file and those that it names, in its folder.
MeshBytes files_beside(const std::filesystem::path& path) {
  return [path](const std::string& name) -> Result<Bytes> {
    const bool itself = name == path.filename().string();
    const auto found =
        itself ? find_file(path, limits::max_asset)
               : find_in_folder(name, path.parent_path().empty() ? "." : path.parent_path(),
                                limits::max_asset, true);
    if (!found) return tl::unexpected(found.error());
    auto text = read_file(*found, limits::max_asset);
    if (!text) return tl::unexpected(text.error());
    const auto owner = std::make_shared<const std::string>(*std::move(text));
    return Bytes(owner, {owner->data(), owner->size()});
  };
}

}  // namespace

Result<MeshFile> load_mesh(const std::filesystem::path& path) {
  auto mesh = read_mesh(path.filename().string(), files_beside(path));
  if (!mesh) mesh.error().file = path.string();
  return mesh;
}

Result<GltfScene> load_gltf_scene(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  const MeshBytes files = files_beside(path);
  auto scene =
      files(name).and_then([&](const Bytes& bytes) { return read_gltf_scene(bytes, name, files); });
  if (!scene) scene.error().file = path.string();
  return scene;
}

MeshFacts mesh_facts(const MeshFile& mesh, const std::filesystem::path& path) {
  MeshFacts facts{.format = format_of(path),
                  .vertices = vertex_count(mesh),
                  .triangles = mesh.triangles.size(),
                  .skipped_faces = mesh.skipped_faces,
                  .parts = parts_of(mesh),
                  .notes = mesh.notes};
  if (facts.vertices > 0) facts.low = facts.high = position(mesh, 0);
  for (std::size_t i = 0; i < facts.vertices; ++i) {
    const Double3 p = position(mesh, i);
    for (std::size_t k = 0; k < 3; ++k) {
      facts.low[k] = std::min(facts.low[k], p[k]);
      facts.high[k] = std::max(facts.high[k], p[k]);
    }
  }
  facts.normals = static_cast<std::uint64_t>(std::count_if(
      mesh.normals.begin(), mesh.normals.end(), [](const Float3& n) { return n != Float3{}; }));
  facts.uvs = static_cast<std::uint64_t>(std::count_if(
      mesh.uvs.begin(), mesh.uvs.end(), [](const Float2& uv) { return std::isfinite(uv[0]); }));
  return facts;
}

std::string skipped_text(const MeshFacts& facts) {
  return counted(facts.skipped_faces, "face that spans", "faces that span") + " no triangle";
}

}  // namespace metamer::client
