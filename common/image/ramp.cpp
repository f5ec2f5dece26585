#include "common/image/ramp.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace metamer {

Rgb cubehelix(double level) {
  constexpr double start = 0.5, rotations = -1.5;
  const double angle = 2 * std::numbers::pi * (start / 3 + rotations * level);
  const double deviation = level * (1 - level) / 2;
  const double c = std::cos(angle), s = std::sin(angle);
  Rgb color = {level + deviation * (-0.14861 * c + 1.78277 * s),
               level + deviation * (-0.29227 * c - 0.90649 * s), level + deviation * (1.97294 * c)};
  for (double& value : color) value = std::clamp(value, 0.0, 1.0);
  return color;
}

Rgb ramp_color(double value, double top) {
  return std::isfinite(value) ? cubehelix(std::min(1.0, value / top)) : Rgb{1, 0, 0};
}

double scale_end(double value) {
  if (!(value > 0)) return 1;
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double nice : {1.0, 2.0, 5.0})
    if (nice * power >= value) return nice * power;
  return 10 * power;
}

}  // namespace metamer
