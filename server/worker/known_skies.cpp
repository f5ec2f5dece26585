#include "server/worker/known_skies.h"

#include <utility>

namespace metamer::worker {

SkyImport KnownSkies::reusing(SkyImport import, const AssetNames& names) {
  return [this, import = std::move(import),
          &names](const std::string& file) -> Result<std::shared_ptr<const ReadSky>> {
    const std::string key = mesh_file_key(file, names);
    if (const auto* known = skies_.ask(key)) return *known;
    return import(file).map([&](auto&& sky) { return skies_.add(key, std::move(sky)); });
  };
}

KnownSkies KnownSkies::asked() && {
  skies_.keep_asked();
  return std::move(*this);
}

}  // namespace metamer::worker
