#include "server/worker/assets.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <fstream>
#include <map>
#include <memory>
#include <set>

#include "common/digest.h"
#include "common/scene/limits.h"
#include "common/scene/names.h"

namespace metamer::worker {

namespace {

struct StoredFile {
  std::filesystem::path path;
  std::size_t size;
};

Result<StoredFile> find_stored(const std::filesystem::path& store, const std::string& digest) {
  const auto known = digest_from_bytes(digest);
  if (!known) return problem("has no digest");
  std::filesystem::path path = store / to_hex(*known);
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) return problem("is not in the store");
  if (size > limits::max_asset) return problem("is too large");
  return StoredFile{std::move(path), size};
}

}  // namespace

Result<std::string> read_stored(const std::filesystem::path& store, const std::string& digest) {
  const auto file = find_stored(store, digest);
  if (!file) return tl::unexpected(file.error());
  std::string bytes(file->size, '\0');
  std::ifstream in(file->path, std::ios::binary);
  if (!in.read(bytes.data(), static_cast<std::streamsize>(file->size)))
    return problem("can't be read");
  return bytes;
}

Result<Bytes> map_stored(const std::filesystem::path& store, const std::string& digest) {
  const auto file = find_stored(store, digest);
  if (!file) return tl::unexpected(file.error());
  const std::size_t size = file->size;
  if (size == 0) return Bytes();
  const int fd = open(file->path.c_str(), O_RDONLY | O_CLOEXEC);
  void* const at = fd < 0 ? MAP_FAILED : mmap(nullptr, size, PROT_READ, MAP_PRIVATE, fd, 0);
  if (fd >= 0) close(fd);
  if (at == MAP_FAILED) return problem("can't be read");
  const std::shared_ptr<void> owner(at, [size](void* from) { munmap(from, size); });
  return Bytes(owner, {static_cast<const char*>(at), size});
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
  // Objects know their material by its place in the list, and have tangents where any one asks.
  std::map<std::string, std::size_t> places;
  bool tangents = false;
  for (std::size_t i = 0; i < compiled.materials.size(); ++i) {
    places[compiled.materials[i].name] = i;
    tangents |= compiled.materials[i].anisotropic();
  }
  key += tangents ? '\1' : '\0';
  std::set<std::string> files;
  for (const v1::Object& object : scene.object()) {
    const std::size_t place = places.at(object.material());
    key += std::to_string(place) + (compiled.materials[place].anisotropic() ? 'a' : 'i');
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
