#include "server/worker/assets.h"

#include <fstream>
#include <map>

#include "common/digest.h"
#include "common/scene/limits.h"

namespace metamer {

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

AssetReader stored_assets(const v1::CompileJob& message, const std::filesystem::path& store) {
  std::map<std::string, std::string> digests;
  for (const v1::AssetName& asset : message.asset()) digests[asset.name()] = asset.sha256();
  return [digests = std::move(digests), store](const std::string& name) -> Result<std::string> {
    const auto found = digests.find(name);
    auto bytes =
        found == digests.end() ? problem("was not sent along") : read_stored(store, found->second);
    if (!bytes) bytes.error().file = name;
    return bytes;
  };
}

std::string geometry_key(v1::Scene scene, const v1::CompileJob& message) {
  for (v1::Light& light : *scene.mutable_light()) {
    light.clear_spectrum();
    light.clear_luminance();
  }
  for (v1::Material& material : *scene.mutable_material()) {
    material.clear_diffuse();
    material.clear_specular();
  }
  v1::Settings settings;
  settings.set_shading(scene.settings().shading());
  *scene.mutable_settings() = settings;
  std::string key = scene.SerializeAsString();
  for (const v1::AssetName& asset : message.asset()) key += asset.name() + asset.sha256();
  return key;
}

}  // namespace metamer
