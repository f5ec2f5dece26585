#pragma once

#include <optional>
#include <string>
#include <tuple>

#include "server/scene/mesh_import.h"
#include "server/worker/assets.h"
#include "server/worker/known.h"

namespace metamer::worker {

/// The meshes that a scene has made of its files: the next scene takes what it needs of them as it
/// is. Copies share the arrays.
class KnownMeshes {
 public:
  /// Imports by `import` what is not known under these names yet, and knows it then. What is named
  /// has to outlive it.
  MeshImport reusing(MeshImport import, const AssetNames& names);

  /// Those that were asked for since then; the others are forgotten.
  KnownMeshes asked() &&;

 private:
  /// Which bytes, and MeshUse.
  using Key = std::tuple<std::string, std::string, std::optional<double>, bool, bool>;
  Known<Key, TriangleMesh> meshes_;
};

}  // namespace metamer::worker
