#include "common/color/chromaticity.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/color/radiators.h"

namespace metamer {
namespace {

// In mireds (1e6 / K) equal steps look about equal.
constexpr double least_mired = 1, most_mired = 1000;
constexpr double farthest_duv = 0.05;

Uv locus(double mired) {
  static const Wavelengths wavelengths = *Wavelengths::uniform(360, 830, 5);
  static const ObserverWeights observer = observer_weights(cie::observer_1931(), wavelengths);
  const Spectrum radiator = planckian(1e6 / mired, wavelengths.nm());
  return uv_1960(*chromaticity(to_xyz(observer, radiator.values)));
}

double distance(const Uv& a, const Uv& b) { return std::hypot(a.u - b.u, a.v - b.v); }

/// The locus at every fifth mired or so, to start from.
const std::vector<Uv>& coarse_locus() {
  static const std::vector<Uv> points = [] {
    std::vector<Uv> made;
    for (int i = 0; i <= 200; ++i)
      made.push_back(locus(least_mired + (most_mired - least_mired) * i / 200));
    return made;
  }();
  return points;
}

}  // namespace

std::optional<Chromaticity> chromaticity(const Xyz& xyz) {
  const double sum = xyz[0] + xyz[1] + xyz[2];
  if (!(sum > 0) || !std::isfinite(sum)) return std::nullopt;
  return Chromaticity{xyz[0] / sum, xyz[1] / sum};
}

Uv uv_1960(const Chromaticity& c) {
  const double sum = 12 * c.y - 2 * c.x + 3;
  return {4 * c.x / sum, 6 * c.y / sum};
}

Uv uv_1976(const Chromaticity& c) {
  const Uv uv = uv_1960(c);
  return {uv.u, 1.5 * uv.v};
}

std::optional<ColorTemperature> color_temperature(const Chromaticity& c) {
  // Take the nearest of the coarse points, which has the nearest of all beside it.
  const Uv own = uv_1960(c);
  const std::vector<Uv>& points = coarse_locus();
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (distance(own, points[i]) < distance(own, points[nearest])) nearest = i;

  // Close in by thirds.
  const double step = (most_mired - least_mired) / static_cast<double>(points.size() - 1);
  const double middle = least_mired + step * static_cast<double>(nearest);
  double low = std::max(least_mired, middle - step), high = std::min(most_mired, middle + step);
  for (int i = 0; i < 60; ++i) {
    const double left = low + (high - low) / 3, right = high - (high - low) / 3;
    if (distance(own, locus(left)) < distance(own, locus(right))) {
      high = right;
    } else {
      low = left;
    }
  }
  const double mired = (low + high) / 2;
  const bool at_an_end = mired - least_mired < 1e-6 || most_mired - mired < 1e-6;
  const Uv body = locus(mired);
  const double off = distance(own, body);
  if (at_an_end || !(off <= farthest_duv)) return std::nullopt;
  return ColorTemperature{1e6 / mired, std::copysign(off, own.v - body.v)};
}

}  // namespace metamer
