#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "common/color/rgb_space.h"
#include "common/problem.h"

namespace metamer {

/// Pixels of `channels.size()` f32 values each, row by row from the top.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;  ///< "R" "G" "B", or "X" "Y" "Z".
  std::vector<float> pixels;          ///< width × height × channels.

  float* at(int x, int y) {
    return pixels.data() + (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                            static_cast<std::size_t>(x)) *
                               channels.size();
  }
  const float* at(int x, int y) const { return const_cast<Image*>(this)->at(x, y); }
};

Image make_image(int width, int height, std::vector<std::string> channels);

/// A run of `pixels`, three values each, through a matrix in f64, which adapts as well.
void to_linear_rgb(const Matrix3& matrix, const float* xyz, float* rgb, std::size_t pixels);

/// How X Y Z become the numbers of a file.
struct Developing {
  RgbSpace space = rgb_space(StandardSpace::srgb);
  Matrix3 adaptation = identity3;  ///< X Y Z as rendered → as seen under the white of the space.
  bool linear = false;             ///< A .png without the space's transfer function.
  int bits = 8;                    ///< Of a .png's samples: 8 or 16.
};

/// What developing an XYZ image for a display lost. Nothing is clamped without being counted, but
/// for what rounding to its bits would have lost anyway: half a step.
struct GamutReport {
  std::size_t negative = 0;  ///< Pixels with an RGB value below 0, or one that is not a number.
  std::size_t above = 0;     ///< Pixels with an RGB value above 1.
};

/// Writes by the extension of `file`: .png is RGB of the space, rounded to nearest, clipped to
/// [0, 1] and counted in the report, with an ICC profile unless it is sRGB's own; .exr is 32-bit
/// float linear RGB, unclipped, with its chromaticities. With `xyz` an .exr holds X Y Z, bit for
/// bit; a .png can't. `metadata` becomes text attributes ("metamer:plan"). The file appears whole
/// or not at all (written beside it, then renamed). Errors name the file: another extension, a
/// folder or a disk that can't be written.
Result<GamutReport> write_image(const Image& xyz_image, const std::filesystem::path& file, bool xyz,
                                const std::map<std::string, std::string>& metadata,
                                const Developing& developing = {});

/// Writes 8-bit RGB of the space as it is, into a .png; the file as write_image has it.
Result<void> write_rgb(int width, int height, std::span<const std::uint8_t> rgb,
                       const std::filesystem::path& file, const Developing& developing);

/// Those of sRGB, as an EXR's attribute `chromaticities` has them.
inline constexpr std::array<float, 8> srgb_chromaticities = {0.64F, 0.33F, 0.30F,   0.60F,
                                                             0.15F, 0.06F, 0.3127F, 0.3290F};

/// Reads a PNG (values as stored, 0..1, not decoded to linear) or an EXR's first part, all its
/// channels, R, G, B and A first; of at most max_image_values. Errors name the file.
Result<Image> read_image(const std::filesystem::path& file);

inline constexpr std::size_t max_image_values = 256u << 20;  ///< 1 GiB: 64 Mpixel of RGBA.

}  // namespace metamer
