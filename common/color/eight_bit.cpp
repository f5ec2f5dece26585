#include "common/color/eight_bit.h"

#include <algorithm>
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
    const auto start = [](unsigned i) {
      return std::bit_cast<float>(std::bit_cast<std::uint32_t>(least) + (i << shift));
    };
    const float first = cell == 0 ? 0 : start(cell);
    while (code < 255 && first >= lowest_[code + 1]) ++code;
    cells_[cell] = {lowest_[code + 1], code};
    const float second = lowest_[std::min(code + 2, 256U)];
    if (second < start(cell + 1) || lowest_[1] < start(1)) single_steps_ = false;
  }
  // Odd for negative values, so the same half step lies below 0.
  below_ = -lowest_[1];
}

void EightBit::operator()(std::span<const float> linear, std::uint8_t* codes) const {
  if (!single_steps_) {
    std::transform(linear.begin(), linear.end(), codes, *this);
    return;
  }
  // The first loop is done by vectors, the second can't be.
  constexpr std::size_t block = 256;
  std::array<float, block> values;
  std::array<std::uint32_t, block> at;
  for (; !linear.empty(); linear = linear.subspan(std::min(block, linear.size()))) {
    const std::size_t count = std::min(block, linear.size());
    for (std::size_t i = 0; i < count; ++i) {
      const float value = linear[i] > least ? linear[i] : least;
      values[i] = value < 1 ? value : 1;
      at[i] = cell_of(values[i]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Cell& cell = cells_[at[i]];
      *codes++ = static_cast<std::uint8_t>(cell.code + (values[i] >= cell.step));
    }
  }
}

}  // namespace metamer
