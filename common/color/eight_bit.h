#pragma once

#include <array>
#include <cstdint>

#include "common/color/rgb_space.h"

namespace metamer {

/// Linear values to 8-bit codes: the nearest to 255 · encode(transfer, value), exactly, by a look
/// at the values where codes change. For pictures, where a power for each value takes too long.
class EightBit {
 public:
  explicit EightBit(const Transfer& transfer);

  /// Below 0 and what is not a number: 0; above 1: 255.
  std::uint8_t operator()(float linear) const {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 255;
    unsigned code = first_code_[static_cast<unsigned>(linear * cells)];
    while (linear >= lowest_[code + 1]) ++code;
    return static_cast<std::uint8_t>(code);
  }

  /// What clipping loses more than rounding does: half a step.
  bool is_below(float linear) const { return !(linear > below_); }
  bool is_above(float linear) const { return linear >= lowest_[256]; }

 private:
  static constexpr unsigned cells = 4096;

  std::array<float, 257> lowest_;                 ///< Value of a code; of 256: above all.
  std::array<std::uint8_t, cells> first_code_{};  ///< Of the values in each of equal cells.
  float below_;
};

}  // namespace metamer
