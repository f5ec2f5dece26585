#include "server/worker/assets.h"

#include <fstream>
#include <map>

#include "common/digest.h"
#include "common/scene/limits.h"

namespace metamer::worker {

Result<std::string> read_stored(const std::filesystem::path& store, const std::string& digest) {
  const auto known = digest_from_bytes(digest);
  if (!known) return problem("has no digest");
  const std::filesystem::path file = store / to_hex(*known);
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) return problem("is not in the store");
  if (size > limits::max_asset) return problem("is too large");
  std::string bytes(size, '\0');
  std::ifstream in(file, std::ios::binary);
  if (!in.read(bytes.data(), static_cast<std::streamsize>(size))) return problem("can't be read");
  return bytes;
}

AssetReader stored_assets(const AssetNames& names, const std::filesystem::path& store) {
  std::map<std::string, std::string> digests;
  for (const v1::AssetName& asset : names) digests[asset.name()] = asset.sha256();
  return [digests = std::move(digests), store](const std::string& name) -> Result<std::string> {
    const auto found = digests.find(name);
    auto bytes =
        found == digests.end() ? problem("was not sent along") : read_stored(store, found->second);
    if (!bytes) bytes.error().file = name;
    return bytes;
  };
}

std::string objects_key(const v1::Scene& scene, const RenderScene& compiled,
                        const AssetNames& names) {
  v1::Scene objects;
  *objects.mutable_object() = scene.object();
  objects.mutable_settings()->set_shading(scene.settings().shading());
  std::string key = objects.SerializeAsString();
  // Objects know their material by its place in the list, and have tangents where any one asks.
  for (const RenderMaterial& material : compiled.materials)
    key += material.name + (material.anisotropic() ? '\1' : '\0');
  for (const v1::AssetName& asset : names) key += asset.name() + asset.sha256();
  return key;
}

std::string geometry_key(const std::string& objects_key, const CameraSpace& space) {
  std::string key = objects_key;
  for (const double number : {space.origin.x(), space.origin.y(), space.origin.z(), space.scale})
    key.append(reinterpret_cast<const char*>(&number), sizeof number);
  return key;
}

}  // namespace metamer::worker
