#include <algorithm>
#include <string_view>

#include "common/mesh/gltf/gltf_mesh.h"
#include "common/mesh/mesh_file.h"
#include "common/mesh/obj/obj_mesh.h"
#include "common/mesh/ply/ply_mesh.h"

namespace metamer {
namespace {

bool ends_with(const std::string& name, std::string_view extension) {
  return name.size() >= extension.size() &&
         std::equal(extension.rbegin(), extension.rend(), name.rbegin(),
                    [](char a, char b) { return a == (b >= 'A' && b <= 'Z' ? b - 'A' + 'a' : b); });
}

}  // namespace

Result<MeshFile> read_mesh(const std::string& name, const MeshBytes& files) {
  auto bytes = files(name);
  if (!bytes) return tl::unexpected(bytes.error());
  if (ends_with(name, ".ply")) return read_ply(*bytes, name);
  if (ends_with(name, ".obj")) return read_obj(*std::move(bytes), name);
  if (ends_with(name, ".gltf") || ends_with(name, ".glb")) return read_gltf(*bytes, name, files);
  return problem("is neither .ply, .obj, .gltf nor .glb");
}

}  // namespace metamer
