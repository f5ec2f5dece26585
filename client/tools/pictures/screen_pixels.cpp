#include "client/tools/pictures/screen_pixels.h"

#include <algorithm>
#include <array>
#include <span>

namespace metamer::client {
namespace {

constexpr std::size_t run_length = 256;  ///< Pixels that are developed at a time.

Matrix3 exposed(Matrix3 matrix, double exposure) {
  for (auto& row : matrix)
    for (double& value : row) value *= exposure;
  return matrix;
}

}  // namespace

ScreenPixels::ScreenPixels(const Developing& developing)
    : matrix_(multiply(developing.space.from_xyz, developing.adaptation)),
      codes_(developing.linear ? Transfer{} : developing.space.transfer) {}

GamutReport ScreenPixels::develop(const float* xyz, std::size_t pixels, double exposure,
                                  std::uint32_t* screen) const {
  std::array<float, 3 * run_length> rgb{};
  std::array<std::uint8_t, 3 * run_length> bytes{};
  const Matrix3 matrix = exposed(matrix_, exposure);
  GamutReport gamut;
  while (pixels > 0) {
    const std::size_t count = std::min(pixels, run_length);
    to_linear_rgb(matrix, xyz, rgb.data(), count);
    codes_(std::span(rgb).first(3 * count), bytes.data());
    for (std::size_t i = 0; i < 3 * count; i += 3) {
      const auto any = [&](auto lost) {
        return lost(rgb[i]) || lost(rgb[i + 1]) || lost(rgb[i + 2]);
      };
      gamut.negative += any([&](float value) { return codes_.is_below(value); });
      gamut.above += any([&](float value) { return codes_.is_above(value); });
      *screen++ = 0xff000000U | std::uint32_t{bytes[i]} << 16 | std::uint32_t{bytes[i + 1]} << 8 |
                  bytes[i + 2];
    }
    xyz += 3 * count;
    pixels -= count;
  }
  return gamut;
}

std::size_t ScreenPixels::find_lost(const float* xyz, std::size_t pixels, double exposure,
                                    std::uint8_t* lost) const {
  std::array<float, 3 * run_length> rgb{};
  const Matrix3 matrix = exposed(matrix_, exposure);
  std::size_t found = 0;
  while (pixels > 0) {
    const std::size_t count = std::min(pixels, run_length);
    to_linear_rgb(matrix, xyz, rgb.data(), count);
    for (std::size_t i = 0; i < count; ++i) {
      const bool any = std::any_of(&rgb[3 * i], &rgb[3 * i] + 3, [&](float value) {
        return codes_.is_below(value) || codes_.is_above(value);
      });
      found += any;
      if (lost != nullptr && any) lost[i] = 1;
    }
    if (lost != nullptr) lost += count;
    xyz += 3 * count;
    pixels -= count;
  }
  return found;
}

}  // namespace metamer::client
