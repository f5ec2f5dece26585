#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "common/problem.h"

namespace metamer {

/// What a PNG of RGB says before its pixels.
struct PngDescription {
  int width = 0;
  int height = 0;
  int bits = 8;             ///< Of a sample: 8, or 16, the high byte first.
  std::string icc_profile;  ///< What the numbers mean; empty: sRGB, which is said by its name.
  std::map<std::string, std::string> texts;  ///< UTF-8.
};

/// The whole file in memory, by libpng. `fill` fills row y; rows are asked for from the top.
Result<std::vector<unsigned char>> encode_png(
    const PngDescription& description, const std::function<void(int y, unsigned char* row)>& fill);

}  // namespace metamer
