#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "common/problem.h"

namespace metamer {

/// Rows from the top, R G B of 8 bits a pixel.
struct RgbBytes {
  int width = 0;
  int height = 0;
  std::vector<unsigned char> rgb;
};

/// A JPEG's pixels as they are stored; a grey one's three are alike. Errors: it is none, it is cut
/// short or damaged, it has channels of another kind, or more than `most` values.
Result<RgbBytes> decode_jpeg(std::string_view bytes, std::uint64_t most);

}  // namespace metamer
