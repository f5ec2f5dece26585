#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/mesh/mesh_file.h"
#include "common/problem.h"
#include "common/scene/validate.h"

namespace metamer {

/// The meshes that a scene makes of one of its files.
struct MeshRequest {
  std::string file;
  struct Mesh {
    std::string field;  ///< Of the scene, that asks first: "object[2].mesh".
    MeshUse use;
  };
  std::vector<Mesh> meshes;
};

/// Imports a file: its meshes in their order. Errors, with their field: see read_mesh(),
/// triangles_of().
using MeshImport = std::function<Result<std::vector<TriangleMesh>>(const MeshRequest&)>;

/// In this process and thread.
Result<std::vector<TriangleMesh>> import_meshes(const MeshRequest& request, const MeshBytes& files);
MeshImport import_here(const AssetReader& assets);

}  // namespace metamer
