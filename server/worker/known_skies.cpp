#include "server/worker/known_skies.h"

#include <utility>

namespace metamer::worker {

SkyImport KnownSkies::reusing(SkyImport import, const AssetNames& names) {
  return [this, import = std::move(import),
          &names](const std::string& file) -> Result<std::shared_ptr<const ReadSky>> {
    const std::string key = mesh_file_key(file, names);
    auto known = skies_.find(key);
    if (known == skies_.end()) {
      auto sky = import(file);
      if (!sky) return sky;
      known = skies_.emplace(key, Known{*std::move(sky)}).first;
    }
    known->second.asked = true;
    return known->second.sky;
  };
}

KnownSkies KnownSkies::asked() && {
  std::erase_if(skies_, [](const auto& known) { return !known.second.asked; });
  for (auto& [key, known] : skies_) known.asked = false;
  return std::move(*this);
}

}  // namespace metamer::worker
