#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common/mesh/array.h"
#include "common/problem.h"
#include "common/scene/validate.h"
#include "metamer/v1/texture.pb.h"

namespace metamer {

/// A picture of weights with its smaller copies.
struct TexturePicture {
  struct Level {
    std::uint32_t width, height;  ///< Pixels.
    std::size_t first;            ///< Its first weight.
  };
  std::uint32_t channels = 0;
  std::vector<Level> levels;  ///< Each half as large as the one before, the last of one pixel.
  /// 65535 is 1; row by row from the top, the channels of a pixel together. Of a pixel they sum to
  /// 1 at most, but for rounding.
  Array<std::uint16_t> weights;
  std::vector<std::string> notes;  ///< What was left aside of the file, a sentence each.
};

/// The picture of a texture that check_texture has nothing against; `field` is the texture's.
/// Errors, with their field and file: a file that is no picture or too large, channels that it has
/// not, a weight out of 0..1 or a sum above 1, a number without a spectrum; each with its pixel.
using TextureImport =
    std::function<Result<TexturePicture>(const v1::Texture& texture, const std::string& field)>;
Result<TexturePicture> read_texture(const v1::Texture& texture, const std::string& field,
                                    const std::string& bytes);
TextureImport textures_of(const AssetReader& assets);

/// The smaller copies of a picture of width × height × channels weights: each pixel is the mean
/// over its part of the level before.
TexturePicture with_levels(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
                           std::vector<std::uint16_t> weights);

/// What a texture is in a compiled scene.
struct RenderTexture {
  TexturePicture picture;
  v1::Texture::Wrap wrap;
  std::array<std::array<float, 3>, 2> map;  ///< Rows: (u, v, 1) of a surface to the picture's.
  /// Of each channel: index into RenderScene::materials of what has its spectrum as `diffuse`.
  std::vector<std::uint32_t> materials;
  /// The picture's pixels along a unit of a surface's UV, the mean of both sides.
  float pixels_per_uv;
  bool has_ground;  ///< What the weights leave is the material's own `diffuse`.
};

/// Adds the weights of `picture` at u, v (of the picture: 0, 0 is its lower left) to `sum`, a value
/// a channel: bilinear between pixels, linear between levels. `level` counts from 0 and may lie
/// between two; below 0 and beyond the last it is the nearest. u and v are finite.
void add_weights(const TexturePicture& picture, v1::Texture::Wrap wrap, float u, float v,
                 float level, float* sum);

/// The map of a texture from a surface's UVs to its picture's.
std::array<std::array<float, 3>, 2> uv_map(const v1::Texture& texture);
/// The root of the pixels of a picture's finest level that a unit square of a surface's UVs has.
float pixels_per_uv(const TexturePicture& picture, const std::array<std::array<float, 3>, 2>& map);

}  // namespace metamer
