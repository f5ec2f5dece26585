#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "common/color/rgb_space.h"

namespace metamer {

/// Linear values to 8-bit codes: the nearest to 255 · encode(transfer, value), exactly, by a look
/// at the values where codes change. For pictures, where a power for each value takes too long.
class EightBit {
 public:
  explicit EightBit(const Transfer& transfer);

  /// Below 0 and what is not a number: 0; above 1: 255.
  std::uint8_t operator()(float linear) const {
    const float value = linear > 0 ? (linear < 1 ? linear : 1) : 0;
    const Cell& cell = cells_[cell_of(value > least ? value : least)];
    unsigned code = cell.code + (value >= cell.step);
    while (value >= lowest_[code + 1]) ++code;  // where a cell holds several steps
    return static_cast<std::uint8_t>(code);
  }
  /// The same of many.
  void operator()(std::span<const float> linear, std::uint8_t* codes) const;

  /// What clipping loses more than rounding does: half a step.
  bool is_below(float linear) const { return !(linear > below_); }
  bool is_above(float linear) const { return linear >= lowest_[256]; }

 private:
  // Cells are equal parts of octaves, found by a float's bits: exponent, 7 bits of the fraction.
  static constexpr float least = 0x1p-24f;  ///< Where they begin.
  static constexpr unsigned shift = 16, cells = (24 << 7) + 1;
  static unsigned cell_of(float value) {
    return (std::bit_cast<std::uint32_t>(value) - std::bit_cast<std::uint32_t>(least)) >> shift;
  }
  struct Cell {
    float step;          ///< The least value of the next code.
    std::uint32_t code;  ///< Of its least value; of 0 in the first.
  };

  std::array<float, 257> lowest_;  ///< Value of a code; of 256: above all.
  std::array<Cell, cells> cells_;
  bool single_steps_ = true;  ///< No cell holds several, nor does any lie below the cells.
  float below_;
};

}  // namespace metamer
