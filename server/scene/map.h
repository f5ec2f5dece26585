#pragma once

#include <optional>

#include "server/scene/texture.h"

namespace metamer {

/// What a map of a material is in a compiled scene: a picture of normals, heights or alpha.
struct RenderMap {
  PlacedPicture placed;
  double strength;              ///< By what x and y of normals are multiplied.
  double height;                ///< Of heights: metres from 0 to 65535 in the picture.
  std::optional<float> cutoff;  ///< Of an alpha: below it is a hole, else all is there.
};

/// Where a map lies, and its channel, as a texture without spectra.
v1::Texture picture_of(const v1::Map& map);

/// The picture of a map that check_map has nothing against, `picture` its picture_of(). Normals
/// have three channels, n = 32768 + 32767 x; of 8 and of 16 bits the number in the middle, 128 or
/// 32768, is 0, so that a flat map is flat. Heights are spread over their own range, `span`; alpha
/// is as it is stored. Errors as read_texture() has them.
Result<TexturePicture> read_map(const v1::Texture& picture, PictureUse use,
                                const std::string& field, const std::string& bytes);

/// Alpha at u, v of a surface: bilinear of the finest pixels under a cutoff, then 0 or 1; else the
/// mean at `level` (PlacedPicture::level). Within 1e-5 of 0 and 1 it is these.
float alpha_at(const RenderMap& map, float u, float v, float level);

}  // namespace metamer
