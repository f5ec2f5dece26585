#include "server/worker/known_meshes.h"

namespace metamer::worker {

MeshImport KnownMeshes::reusing(MeshImport import, const AssetNames& names) {
  return [this, import = std::move(import),
          &names](const MeshRequest& request) -> Result<std::vector<TriangleMesh>> {
    const std::string bytes = mesh_file_key(request.file, names);
    const auto key = [&](const MeshUse& use) {
      return Key{bytes, use.part, use.crease_angle, use.tangents, use.uvs};
    };

    // Import what is missing.
    MeshRequest missing{request.file, {}};
    for (const MeshRequest::Mesh& one : request.meshes)
      if (!meshes_.has(key(one.use))) missing.meshes.push_back(one);
    if (!missing.meshes.empty()) {
      auto imported = import(missing);
      if (!imported) return imported;
      for (std::size_t i = 0; i < missing.meshes.size(); ++i)
        meshes_.add(key(missing.meshes[i].use), std::move((*imported)[i]));
    }

    // Hand out all.
    std::vector<TriangleMesh> meshes;
    for (const MeshRequest::Mesh& one : request.meshes)
      meshes.push_back(*meshes_.ask(key(one.use)));
    return meshes;
  };
}

KnownMeshes KnownMeshes::asked() && {
  meshes_.keep_asked();
  return std::move(*this);
}

}  // namespace metamer::worker
