#include "client/tools/pictures/pixel_reading.h"

#include <algorithm>
#include <cmath>

namespace metamer::client {

PixelReading read_color(const Xyz& xyz, const std::optional<Xyz>& white,
                        const Developing& developing) {
  PixelReading reading{.xyz = xyz, .lab = {}, .encoded = {}, .in_gamut = true};
  if (white && std::all_of(white->begin(), white->end(), [](double value) { return value > 0; }))
    reading.lab = to_lab(xyz, *white);
  const Rgb linear = multiply(developing.space.from_xyz, multiply(developing.adaptation, xyz));
  constexpr double half_step = 0.5 / 255;
  for (std::size_t c = 0; c < 3; ++c) {
    const double value =
        developing.linear ? linear[c] : encode(developing.space.transfer, linear[c]);
    reading.encoded[c] = value;
    // Rounding takes half a step without a loss.
    if (!(value >= -half_step && value <= 1 + half_step)) reading.in_gamut = false;
  }
  return reading;
}

PixelSquare pixel_square(int width, int height, int x, int y, int side) {
  const int before = (side - 1) / 2;
  return {.left = std::max(0, x - before),
          .top = std::max(0, y - before),
          .right = std::min(width - 1, x - before + side - 1),
          .bottom = std::min(height - 1, y - before + side - 1)};
}

Xyz mean_xyz(const Image& xyz, int x, int y, int side) {
  const PixelSquare square = pixel_square(xyz.width, xyz.height, x, y, side);
  Xyz mean{};
  for (int row = square.top; row <= square.bottom; ++row)
    for (int column = square.left; column <= square.right; ++column)
      for (std::size_t c = 0; c < 3; ++c) mean[c] += static_cast<double>(xyz.at(column, row)[c]);
  for (double& value : mean) value /= square.count();
  return mean;
}

Xyz spread_xyz(const Image& xyz, int x, int y, int side) {
  const PixelSquare square = pixel_square(xyz.width, xyz.height, x, y, side);
  const Xyz mean = mean_xyz(xyz, x, y, side);
  Xyz spread{};
  for (int row = square.top; row <= square.bottom; ++row)
    for (int column = square.left; column <= square.right; ++column)
      for (std::size_t c = 0; c < 3; ++c) {
        const double off = static_cast<double>(xyz.at(column, row)[c]) - mean[c];
        spread[c] += off * off;
      }
  for (double& value : spread) value = std::sqrt(value / square.count());
  return spread;
}

}  // namespace metamer::client
