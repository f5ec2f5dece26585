#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/mesh/mesh_file.h"
#include "common/problem.h"
#include "common/scene/validate.h"
#include "metamer/v1/scene.pb.h"

namespace metamer {

/// The meshes that a scene makes of one of its files.
struct MeshRequest {
  std::string file;
  struct Mesh {
    std::string field;  ///< Of the scene, that asks first: "object[2].mesh".
    MeshUse use;
    std::string key = {};  ///< Equal for the objects that share it: mesh_key().
  };
  std::vector<Mesh> meshes;
};

/// What tells a mesh of a scene from others.
std::string mesh_key(const v1::Mesh& mesh);
/// What materials ask of every mesh.
struct MeshNeeds {
  bool tangents = false, uvs = false;
};
/// Each file of a scene once, with each mesh that objects make of it once.
std::vector<MeshRequest> mesh_requests(const v1::Scene& scene, const MeshNeeds& needs);

/// Imports a file: its meshes in their order. Errors, with their field: see read_mesh(),
/// triangles_of().
using MeshImport = std::function<Result<std::vector<TriangleMesh>>(const MeshRequest&)>;

/// In this process and thread.
Result<std::vector<TriangleMesh>> import_meshes(const MeshRequest& request, const MeshBytes& files);
MeshImport import_here(const AssetReader& assets);

}  // namespace metamer
