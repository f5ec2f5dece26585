#include "server/scene/mesh_import.h"

#include <memory>
#include <utility>

namespace metamer {

Result<std::vector<TriangleMesh>> import_meshes(const MeshRequest& request,
                                                const MeshBytes& files) {
  const auto fail = [&](Problem problem, std::string field) {
    problem.field = std::move(field);
    if (problem.file.empty()) problem.file = request.file;
    return tl::unexpected(std::move(problem));
  };
  auto file = read_mesh(request.file, files);
  if (!file) return fail(std::move(file.error()), request.meshes.front().field + ".file");

  std::vector<TriangleMesh> meshes;
  for (const auto& [field, use] : request.meshes) {
    // The last one may take the arrays as they are.
    const bool is_last = meshes.size() + 1 == request.meshes.size();
    auto mesh = is_last ? triangles_of(std::move(*file), use) : triangles_of(*file, use);
    if (!mesh) return fail(std::move(mesh.error()), field + ".part");
    meshes.push_back(*std::move(mesh));
  }
  return meshes;
}

MeshImport import_here(const AssetReader& assets) {
  return [assets](const MeshRequest& request) {
    return import_meshes(request, [&](const std::string& name) {
      return assets(name).map([](std::string&& text) {
        const auto owner = std::make_shared<const std::string>(std::move(text));
        return Bytes(owner, {owner->data(), owner->size()});
      });
    });
  };
}

}  // namespace metamer
