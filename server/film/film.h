#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace metamer {

/// A rectangle of pixels.
struct Rect {
  std::uint32_t x, y, width, height;
};

/// The picture while it is rendered: X Y Z f32, row by row from the top. Does not own its memory,
/// which is shared with the daemon; threads write disjoint pixels.
struct Film {
  float* xyz;
  std::uint32_t width, height;

  void set(std::uint32_t x, std::uint32_t y, const std::array<float, 3>& value) const {
    float* to = xyz + (static_cast<std::size_t>(y) * width + x) * 3;
    to[0] = value[0];
    to[1] = value[1];
    to[2] = value[2];
  }
};

}  // namespace metamer
