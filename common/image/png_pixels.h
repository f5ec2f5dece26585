#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace metamer {

/// What a PNG's IDAT holds (PNG, 3rd edition, 9 and 10): `height` rows of `row` bytes, at least one
/// of each, filtered by what is above them (Up), as a stream of zlib. `fill` fills row y; rows are
/// asked for from the top.
///
/// By ISA-L: zlib at its level 3, by libpng, took five times as long for a tenth fewer bytes.
std::vector<unsigned char> png_pixels(std::size_t row, int height,
                                      const std::function<void(int y, unsigned char* row)>& fill);

}  // namespace metamer
