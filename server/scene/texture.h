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
  float span = 1;                  ///< Of heights: what 65535 is in the file, less what 0 is.
  std::vector<std::string> notes;  ///< What was left aside of the file, a sentence each.
};

/// What the numbers of a picture are.
enum class PictureUse : unsigned char {
  texture,  ///< Weights of spectra, or colours.
  normals,  ///< x, y and z of tangent space.
  heights,
  alpha,
};

/// The picture of a texture that check_texture has nothing against; `field` is the texture's.
/// Errors, with their field and file: a file that is no picture or too large, channels that it has
/// not, a weight out of 0..1 or a sum above 1, a number without a spectrum; each with its pixel.
using TextureImport = std::function<Result<TexturePicture>(
    const v1::Texture& texture, PictureUse use, const std::string& field)>;
Result<TexturePicture> read_texture(const v1::Texture& texture, const std::string& field,
                                    const std::string& bytes);
/// Also the pictures of maps, by their picture_of().
TextureImport textures_of(const AssetReader& assets);

/// The smaller copies of a picture of width × height × channels weights: each pixel is the mean
/// over its part of the level before.
TexturePicture with_levels(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
                           std::vector<std::uint16_t> weights);

/// A picture where it lies on a surface.
struct PlacedPicture {
  PlacedPicture(TexturePicture of, const v1::Texture& texture);

  TexturePicture picture;
  v1::Texture::Wrap wrap;
  std::array<std::array<float, 3>, 2> map;  ///< Rows: (u, v, 1) of a surface to the picture's.
  /// The picture's pixels along a unit of a surface's UV, the mean of both sides.
  float pixels_per_uv;

  /// u, v of a surface as those of the picture.
  std::array<float, 2> at(float u, float v) const {
    return {map[0][0] * u + map[0][1] * v + map[0][2], map[1][0] * u + map[1][1] * v + map[1][2]};
  }
  /// The level at which a pixel is as large as a sample that covers `covered` / `slant` of a
  /// surface's UV along one side.
  float level(float covered, float slant) const;
};

/// What a texture is in a compiled scene.
struct RenderTexture {
  PlacedPicture placed;
  /// Of each channel: index into RenderScene::materials of what has its spectrum as `diffuse`.
  std::vector<std::uint32_t> materials;
  bool has_ground;  ///< What the weights leave is the material's own `diffuse`.
};

/// Adds the weights of `picture` at u, v (of the picture: 0, 0 is its lower left) to `sum`, a value
/// a channel: bilinear between pixels, linear between levels. `level` counts from 0 and may lie
/// between two; below 0 and beyond the last it is the nearest, of a NaN the first. Where u or v is
/// not finite it is a pixel of the border.
void add_weights(const TexturePicture& picture, v1::Texture::Wrap wrap, float u, float v,
                 float level, float* sum);

}  // namespace metamer
