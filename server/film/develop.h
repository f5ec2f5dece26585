#pragma once

#include <cstdint>
#include <span>

#include "common/color/eight_bit.h"
#include "common/scene/development.h"

namespace metamer {

/// X Y Z to the 8-bit RGB of a plan's development: what a client writes into a .png.
class Developer {
 public:
  /// Error: a space that there can't be.
  static Result<Developer> make(const v1::Plan& plan);

  /// Of pixels, three values each, `scale` times theirs. Returns how many lie outside the RGB
  /// space, and were clipped.
  std::uint64_t develop(std::span<const float> xyz, float scale, std::span<std::uint8_t> rgb) const;

 private:
  Developer(const PlannedDevelopment& planned, bool linear);

  Matrix3 matrix_;
  EightBit codes_;
};

}  // namespace metamer
