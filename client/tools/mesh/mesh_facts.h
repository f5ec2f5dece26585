#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/mesh/gltf/gltf_scene.h"
#include "common/mesh/mesh_file.h"

/// What a mesh file holds.
namespace metamer::client {

/// The triangles of one object and one material.
struct MeshPart {
  std::string object, material;  ///< Their names in the file; may be empty.
  std::uint64_t triangles = 0;
  /// What a scene's `part` says for them alone: the material, else the object, else both. Empty: no
  /// name tells them from others, or nothing else is there.
  std::string part;
  bool has_uvs = false;  ///< All corners of its triangles.
};

struct MeshFacts {
  std::string format;  ///< "PLY", "OBJ", "glTF"
  std::uint64_t vertices = 0, triangles = 0;
  Double3 low{}, high{};               ///< The box around its vertices.
  std::uint64_t normals = 0, uvs = 0;  ///< Vertices that have them.
  std::uint64_t skipped_faces = 0;     ///< Faces that span no triangle.
  std::vector<MeshPart> parts;         ///< In the file's order, each once.
  std::vector<std::string> notes;      ///< What was left out.
};

/// Reads a mesh file and those that it names, which lie in its folder. Each has at most
/// limits::max_asset bytes, and what they become is bounded by them. Errors: those of find_file and
/// read_mesh.
Result<MeshFile> load_mesh(const std::filesystem::path& path);

/// What a glTF says beside its triangles.
Result<GltfScene> load_gltf_scene(const std::filesystem::path& path);

/// Of a file that was read from `path`.
MeshFacts mesh_facts(const MeshFile& mesh, const std::filesystem::path& path);

/// "2 faces that span no triangle"
std::string skipped_text(const MeshFacts& facts);

}  // namespace metamer::client
