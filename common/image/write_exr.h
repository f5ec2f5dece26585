#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/image/image.h"

/// EXR files of 32-bit floats are written, by OpenEXR; in the calling thread alone.
namespace metamer {

/// What an EXR says before its pixels.
struct ExrDescription {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;
  std::optional<std::array<float, 8>> chromaticities;  ///< x y of red, green, blue, white.
  std::map<std::string, float> numbers;                ///< Attributes.
  std::map<std::string, std::string> texts;            ///< Attributes.
};

/// Fills rows from y to end: values of the channels, pixel by pixel.
using FillRows = std::function<void(int y, int end, float* values)>;

/// The whole file in memory, compressed by ZIP: a disk that fills up can then be told from a
/// picture that can't be encoded. Asks for a few rows at a time, from the top.
Result<std::vector<unsigned char>> encode_exr(const ExrDescription& description,
                                              const FillRows& fill);

}  // namespace metamer
