#include "server/scene/mesh_import.h"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

namespace metamer {

std::string mesh_key(const v1::Mesh& mesh) { return mesh.SerializeAsString(); }

std::vector<MeshRequest> mesh_requests(const v1::Scene& scene, const MeshNeeds& needs) {
  std::vector<MeshRequest> requests;
  std::map<std::string, std::size_t> places;  ///< Of files.
  std::set<std::string> keys;
  for (int i = 0; i < scene.object_size(); ++i) {
    if (!scene.object(i).has_mesh()) continue;
    const v1::Mesh& mesh = scene.object(i).mesh();
    const std::string key = mesh_key(mesh);
    if (!keys.insert(key).second) continue;
    const auto [place, is_new] = places.try_emplace(mesh.file(), requests.size());
    if (is_new) requests.push_back({mesh.file(), {}});
    const auto crease_angle =
        mesh.has_crease_angle() ? std::optional(mesh.crease_angle()) : std::nullopt;
    requests[place->second].meshes.push_back(
        {"object[" + std::to_string(i) + "].mesh",
         {mesh.part(), crease_angle, needs.tangents, needs.uvs},
         key});
  }
  return requests;
}

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
  for (const auto& [field, use, key] : request.meshes) {
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
