#include "common/color/eight_bit.h"

#include <cmath>
#include <limits>

namespace metamer {
namespace {

/// The least f32 whose code is at least this.
float lowest_of(const Transfer& transfer, double code) {
  const auto reaches = [&](float value) {
    return 255 * encode(transfer, static_cast<double>(value)) >= code;
  };
  constexpr float infinity = std::numeric_limits<float>::infinity();
  // decode() is right but for rounding: look at the neighbours.
  auto value = static_cast<float>(decode(transfer, code / 255));
  while (reaches(std::nextafter(value, -infinity))) value = std::nextafter(value, -infinity);
  while (!reaches(value)) value = std::nextafter(value, infinity);
  return value;
}

}  // namespace

EightBit::EightBit(const Transfer& transfer) {
  lowest_[0] = 0;
  for (unsigned code = 1; code <= 256; ++code) lowest_[code] = lowest_of(transfer, code - 0.5);
  unsigned code = 0;
  for (unsigned cell = 0; cell < cells; ++cell) {
    const float least = static_cast<float>(cell) / cells;
    while (code < 255 && least >= lowest_[code + 1]) ++code;
    first_code_[cell] = static_cast<std::uint8_t>(code);
  }
  // Odd for negative values, so the same half step lies below 0.
  below_ = -lowest_[1];
}

}  // namespace metamer
