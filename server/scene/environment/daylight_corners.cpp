#include "server/scene/environment/daylight_corners.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "common/color/radiators.h"
#include "common/color/xyz.h"
#include "common/spectral/cie.h"

namespace metamer {
namespace {

constexpr std::size_t directions = 48;

/// What lies on the one side of a line: a x + b y is at most c.
struct Tangent {
  double a, b, c;
  double beyond(const Chromaticity& at) const { return a * at.x + b * at.y - c; }
};

std::vector<Tangent> tangents_around(const std::vector<Chromaticity>& within) {
  std::vector<Tangent> tangents;
  for (std::size_t i = 0; i < directions; ++i) {
    const double turn = 2 * std::numbers::pi * static_cast<double>(i) / directions;
    Tangent one{std::cos(turn), std::sin(turn), -std::numeric_limits<double>::infinity()};
    for (const Chromaticity& at : within) one.c = std::max(one.c, one.a * at.x + one.b * at.y);
    tangents.push_back(one);
  }
  return tangents;
}

/// Where two of them meet, and how much light its spectrum has at least, by that at 560 nm.
struct Corner {
  Chromaticity at;
  double least;
};

std::optional<Corner> corner_of(const Tangent& one, const Tangent& other) {
  const double turned = one.a * other.b - one.b * other.a;
  if (std::abs(turned) < 1e-6) return {};
  const Chromaticity at = {(one.c * other.b - other.c * one.b) / turned,
                           (one.a * other.c - other.a * one.c) / turned};
  const Spectrum spectrum = daylight_of(at.x, at.y);
  const double at_560 = resample(spectrum, {560}, Outside::zero).values.front();
  // What has nothing of the first component is no daylight.
  if (!(at_560 > 1)) return {};
  double least = at_560;
  for (std::size_t i = 0; i < spectrum.nm.size(); ++i)
    if (spectrum.nm[i] >= observer_from_nm) least = std::min(least, spectrum.values[i]);
  return Corner{at, least / at_560};
}

double twice_area(const Chromaticity& a, const Chromaticity& b, const Chromaticity& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

std::array<Chromaticity, 3> best_corners(const std::vector<Tangent>& tangents) {
  constexpr double clearly = 1e-3;  // Three tangents through a point have no triangle.
  std::vector<std::optional<Corner>> known(directions * directions);
  for (std::size_t i = 0; i < directions; ++i)
    for (std::size_t j = i + 1; j < directions; ++j)
      known[i * directions + j] = corner_of(tangents[i], tangents[j]);
  std::array<Chromaticity, 3> best{};
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < directions; ++i)
    for (std::size_t j = i + 1; j < directions; ++j)
      for (std::size_t k = j + 1; k < directions; ++k) {
        const auto &one = known[i * directions + j], &other = known[i * directions + k],
                   &third = known[j * directions + k];
        if (!one || !other || !third) continue;
        const double least = std::min({one->least, other->least, third->least});
        if (least <= most || tangents[k].beyond(one->at) > -clearly ||
            tangents[j].beyond(other->at) > -clearly || tangents[i].beyond(third->at) > -clearly)
          continue;
        most = least;
        best = {one->at, other->at, third->at};
      }
  return best;
}

}  // namespace

DaylightCorners::DaylightCorners(const std::vector<Chromaticity>& within)
    : corners_(best_corners(tangents_around(within))) {
  for (std::size_t i = 0; i < 3; ++i) {
    Spectrum& spectrum = spectra_.emplace_back(daylight_of(corners_[i].x, corners_[i].y));
    for (double& value : spectrum.values) value = std::max(value, 0.0);
    luminances_[i] = emission_xyz(spectrum, cie::observer_1931())[1];
  }
}

Vector3 DaylightCorners::shares(const Chromaticity& of, double luminance) const {
  const auto& [a, b, c] = corners_;
  Vector3 shares = {twice_area(of, b, c), twice_area(a, of, c), twice_area(a, b, of)};
  const double whole = twice_area(a, b, c);
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    shares[i] = std::max(0.0, shares[i] / whole);
    sum += shares[i] * luminances_[i];
  }
  for (double& share : shares) share *= luminance / sum;
  return shares;
}

}  // namespace metamer
