#include "server/worker/known_textures.h"

namespace metamer::worker {
namespace {

/// What of a texture decides its weights: all but the spectra themselves and where it lies.
std::string key_of(const v1::Texture& texture, PictureUse use, const AssetNames& names) {
  v1::Texture picture;
  *picture.mutable_channel() = texture.channel();
  picture.set_use(texture.use());
  return std::to_string(static_cast<int>(use)) + ' ' + std::to_string(texture.spectrum_size()) +
         ' ' + picture.SerializeAsString() + mesh_file_key(texture.file(), names);
}

}  // namespace

TextureImport KnownTextures::reusing(TextureImport import, const AssetNames& names) {
  return [this, import = std::move(import), &names](
             const v1::Texture& texture, PictureUse use,
             const std::string& field) -> Result<TexturePicture> {
    const std::string key = key_of(texture, use, names);
    if (const auto* known = pictures_.ask(key)) return *known;
    return import(texture, use, field).map([&](auto&& picture) {
      return pictures_.add(key, std::move(picture));
    });
  };
}

KnownTextures KnownTextures::asked() && {
  pictures_.keep_asked();
  return std::move(*this);
}

}  // namespace metamer::worker
