#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "common/image/pixel_spectrum.h"
#include "common/mesh/gltf/buffers.h"
#include "common/scene/files.h"
#include "common/scene/findings.h"
#include "common/scene/limits.h"
#include "common/scene/names.h"
#include "common/scene/scene_file.h"
#include "common/spectral/files/spectrum_file.h"

namespace metamer {

namespace {

// "Did you mean" lists a folder; a scene whose folder is not there at all needs it no more often.
constexpr std::size_t max_guesses = 10;

/// Collects each file once, in the order in which the scene names them.
class Collector {
 public:
  Collector(std::filesystem::path folder, const DigestOf& digest_of, const Elsewhere& elsewhere)
      : folder_(std::move(folder)), digest_of_(digest_of), elsewhere_(elsewhere) {}

  void add_table(const std::string& file, const std::string& field) {
    add(file, field, max_spectrum_file);
  }

  void add_spectrum(const v1::Spectrum& spectrum, const std::string& field) {
    if (spectrum.source_case() != v1::Spectrum::kFile) return;
    add(spectrum.file(), field + ".file",
        is_picture_of_spectra(spectrum.file()) ? max_spectral_picture : max_spectrum_file);
  }

  void add_picture(const std::string& file, const std::string& field) {
    add(file, field + ".file", limits::max_asset);
  }

  void add_mesh(const v1::Mesh& mesh, const std::string& field) {
    const bool gltf = has_extension(mesh.file(), ".gltf");
    const std::string path = field + ".file";
    const Asset* asset = add(mesh.file(), path, gltf ? max_gltf_text : limits::max_asset);
    if (asset == nullptr || !gltf) return;

    // A .gltf names further files.
    const auto text = read_file(asset->path, max_gltf_text);
    if (!text) return findings_.add(path, "file " + quoted(mesh.file()) + " can't be read");
    const auto buffers = gltf_buffers(*text, mesh.file());
    if (!buffers) return findings_.add(path, buffers.error().message);
    for (const std::string& buffer : *buffers) {
      add(buffer, path, limits::max_asset, quoted(mesh.file()) + " names a buffer: ");
    }
  }

  tl::expected<std::vector<Asset>, std::vector<Problem>> finish() {
    if (findings_.size() > 0) return tl::unexpected(findings_.take());
    return std::move(assets_);
  }

 private:
  /// The asset if it is new and sound; else null. `prefix` begins the problems' messages.
  const Asset* add(const std::string& name, const std::string& field, std::uint64_t limit,
                   const std::string& prefix = {}) {
    if (name.empty()) return nullptr;
    const auto [seen, is_new] = seen_.try_emplace(name);
    // Of the scene's own folder, one name is one file.
    if (!is_new && elsewhere_.empty()) return nullptr;
    const auto path = find(name, field, limit);
    if (!path) {
      Problem wrong = path.error();
      wrong.message = prefix + wrong.message;
      if (!prefix.empty()) wrong.was = wrong.meant = {};  // it does not stand in the scene
      findings_.add(field, std::move(wrong));
      return nullptr;
    }
    if (!is_new) {
      std::error_code error;
      if (!seen->second.empty() && !std::filesystem::equivalent(*path, seen->second, error))
        findings_.add(field, "another file of the scene is called " + quoted(name) + ", too");
      return nullptr;
    }
    seen->second = *path;
    const auto digest = digest_of_(*path, limit);
    if (!digest) {
      findings_.add(field, prefix + "file " + quoted(name) + " " + digest.error().message);
      return nullptr;
    }
    if (digest->size == 0) {
      findings_.add(field, prefix + "file " + quoted(name) + " is empty");
      return nullptr;
    }
    assets_.push_back({name, field, *path, digest->size, digest->sha256});
    return &assets_.back();
  }

  Result<std::filesystem::path> find(const std::string& name, const std::string& field,
                                     std::uint64_t limit) const {
    const auto other = elsewhere_.find(field);
    if (other != elsewhere_.end()) return find_file(other->second, limit);
    return find_in_folder(name, folder_, limit, findings_.size() < max_guesses);
  }

  std::filesystem::path folder_;
  const DigestOf& digest_of_;
  const Elsewhere& elsewhere_;
  std::map<std::string, std::filesystem::path> seen_;  ///< By their names.
  std::vector<Asset> assets_;
  Findings findings_;
};

}  // namespace

tl::expected<std::vector<Asset>, std::vector<Problem>> collect_assets(
    const v1::Scene& scene, const std::filesystem::path& folder, const DigestOf& digest_of,
    const Elsewhere& elsewhere) {
  Collector collector(folder.empty() ? std::filesystem::path(".") : folder, digest_of, elsewhere);
  for_each_spectrum(scene, [&](const v1::Spectrum& spectrum, const std::string& field,
                               SpectrumRole) { collector.add_spectrum(spectrum, field); });
  for_each_observer_file(scene, [&](const std::string& file, const std::string& field) {
    collector.add_table(file, field);
  });
  for_each_bispectral_file(scene, [&](const std::string& file, const std::string& field) {
    collector.add_table(file, field);
  });
  for (int i = 0; i < scene.material_size(); ++i) {
    const v1::Material& material = scene.material(i);
    const std::string field = indexed("material", static_cast<std::size_t>(i));
    collector.add_picture(material.texture().file(), field + ".texture");
    collector.add_picture(material.normal_map().file(), field + ".normal_map");
    collector.add_picture(material.bump_map().file(), field + ".bump_map");
    collector.add_picture(material.alpha().file(), field + ".alpha");
  }
  for (int i = 0; i < scene.light_size(); ++i)
    collector.add_picture(scene.light(i).environment().file(),
                          indexed("light", static_cast<std::size_t>(i)) + ".environment");
  for (int i = 0; i < scene.object_size(); ++i) {
    if (!scene.object(i).has_mesh()) continue;
    collector.add_mesh(scene.object(i).mesh(),
                       indexed("object", static_cast<std::size_t>(i)) + ".mesh");
  }
  return collector.finish();
}

}  // namespace metamer
