#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

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

/// What developing an XYZ image for a display lost. Nothing is clamped without being counted.
struct GamutReport {
  std::size_t negative = 0;  ///< Pixels with an RGB value below 0.
  std::size_t above = 0;     ///< Pixels with an RGB value above 1.
};

/// XYZ → linear sRGB, values as they come.
Image to_linear_srgb(const Image& xyz);

/// Writes by the extension of `file`: .png is 8-bit sRGB, rounded to nearest, clipped to [0, 1]
/// and counted in the report; .exr is 32-bit float linear sRGB. With `xyz` an .exr holds X Y Z.
/// `metadata` becomes text attributes ("metamer:plan"). The file appears whole or not at all
/// (written beside it, then renamed). Errors: another extension, a folder that can't be written.
Result<GamutReport> write_image(const Image& xyz_image, const std::filesystem::path& file,
                                bool xyz, const std::map<std::string, std::string>& metadata);

/// Reads a PNG (decoded to linear is not done: values as stored, 0..1) or an EXR.
Result<Image> read_image(const std::filesystem::path& file);

}  // namespace metamer
