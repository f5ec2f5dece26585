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
    auto known = pictures_.find(key);
    if (known == pictures_.end()) {
      auto picture = import(texture, use, field);
      if (!picture) return picture;
      known = pictures_.emplace(key, Known{*std::move(picture)}).first;
    }
    known->second.asked = true;
    return known->second.picture;
  };
}

KnownTextures KnownTextures::asked() && {
  std::erase_if(pictures_, [](const auto& known) { return !known.second.asked; });
  for (auto& [key, known] : pictures_) known.asked = false;
  return std::move(*this);
}

}  // namespace metamer::worker
