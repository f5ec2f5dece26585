#pragma once

#include "server/scene/mesh_import.h"

namespace metamer::test {

/// All of a file as one mesh.
inline Result<TriangleMesh> import_one(const std::string& name, const AssetReader& assets) {
  return import_here(assets)({name, {{"object[0].mesh", {}}}}).map([](auto&& meshes) {
    return std::move(meshes.front());
  });
}

}  // namespace metamer::test
