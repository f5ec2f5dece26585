#include "server/worker/assets.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "common/digest.h"
#include "common/scene/limits.h"
#include "common/scene/names.h"

namespace metamer::worker {

namespace {

constexpr const char* damage = "the server's file is damaged; send it again";

std::string digest_of(const std::string& name, const AssetNames& names) {
  // The last one is meant.
  for (int i = names.size(); i-- > 0;)
    if (names[i].name() == name) return names[i].sha256();
  return {};
}

}  // namespace

std::uint64_t stored_bytes(const std::filesystem::path& store, const std::string& digest) {
  const auto known = digest_from_bytes(digest);
  std::error_code error;
  const auto size = known ? std::filesystem::file_size(store / to_hex(*known), error) : 0;
  return error ? 0 : size;
}

Result<std::string> read_stored(const std::filesystem::path& store, const std::string& digest) {
  const auto known = digest_from_bytes(digest);
  if (!known) return problem("has no digest");
  const std::uint64_t size = stored_bytes(store, digest);
  if (size > limits::max_asset) return problem(damage);

  // Hash each piece while the processor has it at hand.
  constexpr std::size_t piece = 256u << 10;
  std::string bytes(size, '\0');
  DigestStream sum;
  std::ifstream in(store / to_hex(*known), std::ios::binary);
  for (std::size_t at = 0; at < bytes.size(); at += piece) {
    const std::size_t length = std::min(piece, bytes.size() - at);
    if (!in.read(bytes.data() + at, static_cast<std::streamsize>(length))) break;
    sum.update({bytes.data() + at, length});
  }
  if (!in || sum.finish() != *known) return problem(damage);
  return bytes;
}

bool is_damage(const Problem& problem) { return problem.message == damage; }

AssetReader stored_assets(const AssetNames& names, const std::filesystem::path& store,
                          const TellDamage& tell_damage) {
  return [names, store, tell_damage](const std::string& name) -> Result<std::string> {
    const std::string digest = digest_of(name, names);
    auto bytes = digest.empty() ? problem("was not sent along") : read_stored(store, digest);
    if (bytes) return bytes;
    bytes.error().file = name;
    tell_damage_of(bytes.error(), names, tell_damage);
    return bytes;
  };
}

void tell_damage_of(const Problem& problem, const AssetNames& names,
                    const TellDamage& tell_damage) {
  if (is_damage(problem)) tell_damage(digest_of(problem.file, names));
}

std::string mesh_file_key(const std::string& file, const AssetNames& names) {
  const bool names_others = has_extension(file, ".gltf");
  std::string key = file + '\0';
  for (const v1::AssetName& asset : names)
    if (names_others || asset.name() == file) key += asset.name() + '\0' + asset.sha256();
  return key;
}

std::string objects_key(const v1::Scene& scene, const RenderScene& compiled,
                        const AssetNames& names) {
  v1::Scene objects;
  *objects.mutable_object() = scene.object();
  objects.mutable_settings()->set_shading(scene.settings().shading());
  std::string key = objects.SerializeAsString();
  // Objects know their material by its place in the list, and have tangents and UVs where any one
  // asks.
  std::map<std::string, std::size_t> places;
  bool tangents = false, uvs = false;
  const bool passed = !compiled.media.empty() || compiled.has_alpha();  // then rays pass surfaces
  for (std::size_t i = 0; i < compiled.materials.size(); ++i) {
    places[compiled.materials[i].name] = i;
    tangents |= compiled.materials[i].anisotropic();
    uvs |= compiled.materials[i].has_picture();
  }
  key += tangents ? '\1' : '\0';
  key += uvs ? '\1' : '\0';
  key += passed ? '\1' : '\0';
  std::set<std::string> files;
  for (const v1::Object& object : scene.object()) {
    const std::size_t place = places.at(object.material());
    key += std::to_string(place) + (compiled.materials[place].anisotropic() ? 'a' : 'i') +
           (compiled.materials[place].has_picture() ? 't' : '-') +
           (compiled.materials[place].turns_normals() ? 'n' : '-');
    if (object.has_mesh() && files.insert(object.mesh().file()).second)
      key += mesh_file_key(object.mesh().file(), names);
  }
  return key;
}

std::string geometry_key(const std::string& objects_key, const CameraSpace& space) {
  std::string key = objects_key;
  for (const double number : {space.origin.x(), space.origin.y(), space.origin.z(), space.scale})
    key.append(reinterpret_cast<const char*>(&number), sizeof number);
  return key;
}

}  // namespace metamer::worker
