#pragma once

#include <memory>
#include <string>

#include "server/scene/environment/sky_picture.h"
#include "server/worker/assets.h"
#include "server/worker/known.h"

namespace metamer::worker {

/// The pictures that a scene has read for its environment, as KnownTextures has those of textures.
/// Copies share them.
class KnownSkies {
 public:
  /// Reads by `import` what is not known under these names yet, and knows it then. What is named
  /// has to outlive it.
  SkyImport reusing(SkyImport import, const AssetNames& names);

  /// Those that were asked for since then; the others are forgotten.
  KnownSkies asked() &&;

 private:
  Known<std::string, std::shared_ptr<const ReadSky>> skies_;  ///< By their names and bytes.
};

}  // namespace metamer::worker
