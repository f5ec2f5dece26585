#pragma once

#include <string>

#include "server/scene/texture.h"
#include "server/worker/assets.h"
#include "server/worker/known.h"

namespace metamer::worker {

/// The pictures that a scene has read for its textures: the next scene takes what it needs of them
/// as it is. Copies share the weights.
class KnownTextures {
 public:
  /// Reads by `import` what is not known under these names yet, and knows it then. What is named
  /// has to outlive it.
  TextureImport reusing(TextureImport import, const AssetNames& names);

  /// Those that were asked for since then; the others are forgotten.
  KnownTextures asked() &&;

 private:
  /// By what of the texture decides them, and the bytes.
  Known<std::string, TexturePicture> pictures_;
};

}  // namespace metamer::worker
