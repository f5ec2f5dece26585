#include "server/scene/environment/daylight_sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "server/scene/environment/daylight_corners.h"

namespace metamer {
namespace {

constexpr double pi = std::numbers::pi;

/// Pixels of a third of a degree.
constexpr std::uint32_t sky_width = 1024, sky_height = sky_width / 2;

/// θ³ to 1 of the sun's angle to the zenith, by T² to 1 of the turbidity.
using ZenithTable = std::array<std::array<double, 4>, 3>;
constexpr ZenithTable zenith_x = {{{0.00166, -0.00375, 0.00209, 0},
                                   {-0.02903, 0.06377, -0.03202, 0.00394},
                                   {0.11693, -0.21196, 0.06052, 0.25886}}};
constexpr ZenithTable zenith_y = {{{0.00275, -0.00610, 0.00317, 0},
                                   {-0.04214, 0.08970, -0.04153, 0.00516},
                                   {0.15346, -0.26756, 0.06670, 0.26688}}};

double at_zenith(const ZenithTable& table, double turbidity, double angle) {
  double sum = 0;
  for (const auto& row : table) {
    double of_angle = 0;
    for (const double factor : row) of_angle = of_angle * angle + factor;
    sum = sum * turbidity + of_angle;
  }
  return sum;
}

}  // namespace

double DaylightSky::Perez::value(double zenith_cosine, double sun_angle, double sun_cosine) const {
  return (1 + a[0] * std::exp(a[1] / zenith_cosine)) *
         (1 + a[2] * std::exp(a[3] * sun_angle) + a[4] * sun_cosine * sun_cosine);
}

DaylightSky::DaylightSky(double turbidity, double elevation)
    : sun_zenith_((90 - elevation) * pi / 180) {
  const double t = turbidity;
  luminance_.a = {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251,
                  0.1206 * t - 2.5771, -0.0670 * t + 0.3703};
  x_.a = {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
          -0.0033 * t + 0.0452};
  y_.a = {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
          -0.0109 * t + 0.0529};
  const double chi = (4.0 / 9 - t / 120) * (pi - 2 * sun_zenith_);
  luminance_.zenith = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;
  x_.zenith = at_zenith(zenith_x, t, sun_zenith_);
  y_.zenith = at_zenith(zenith_y, t, sun_zenith_);
  for (Perez* one : {&x_, &y_, &luminance_})
    one->zenith /= one->value(1, sun_zenith_, std::cos(sun_zenith_));
}

DaylightSky::Colour DaylightSky::at(double zenith_cosine, double sun_cosine) const {
  const double angle = std::acos(std::clamp(sun_cosine, -1.0, 1.0));
  const auto of = [&](const Perez& one) {
    return one.zenith * one.value(zenith_cosine, angle, sun_cosine);
  };
  return {of(x_), of(y_), of(luminance_)};
}

PaintedSky paint(const DaylightSky& sky) {
  // The colours of the upper half's left half, at the middles of pixels: the right one is like it.
  constexpr std::uint32_t half_width = sky_width / 2, half_height = sky_height / 2;
  std::vector<DaylightSky::Colour> colours;
  std::vector<Chromaticity> chromaticities;
  const double sun_sine = std::sin(sky.sun_zenith()), sun_cosine = std::cos(sky.sun_zenith());
  const auto zenith_of = [](std::uint32_t y) { return (y + 0.5) * pi / sky_height; };
  for (std::uint32_t y = 0; y < half_height; ++y) {
    const double sine = std::sin(zenith_of(y)), cosine = std::cos(zenith_of(y));
    for (std::uint32_t x = 0; x < half_width; ++x) {
      const double turn = ((x + 0.5) / sky_width - 0.5) * 2 * pi;
      colours.push_back(sky.at(cosine, sine * sun_sine * std::cos(turn) + cosine * sun_cosine));
      chromaticities.push_back({colours.back().x, colours.back().y});
    }
  }

  // As shares of three spectra.
  const DaylightCorners corners(chromaticities);
  PaintedSky painted{{sky_width, sky_height, {}, {}}, corners.spectra(), {}};
  std::vector<float>& values = painted.picture.values;
  values.resize(std::size_t{3} * sky_width * sky_height);
  Vector3 on_ground{};
  for (std::uint32_t y = 0; y < half_height; ++y)
    for (std::uint32_t x = 0; x < half_width; ++x) {
      const std::size_t place = std::size_t{y} * half_width + x;
      const Vector3 shares = corners.shares(chromaticities[place], colours[place].luminance);
      for (std::size_t part = 0; part < 3; ++part) {
        const std::size_t row = std::size_t{y} * sky_width;
        values[(row + x) * 3 + part] = values[(row + sky_width - 1 - x) * 3 + part] =
            static_cast<float>(shares[part]);
        on_ground[part] += shares[part] * std::cos(zenith_of(y)) * std::sin(zenith_of(y));
      }
    }
  painted.whole = painted.parts[0];
  for (std::size_t i = 0; i < painted.whole.values.size(); ++i) {
    painted.whole.values[i] = 0;
    for (std::size_t part = 0; part < 3; ++part)
      painted.whole.values[i] += on_ground[part] * painted.parts[part].values[i];
  }
  return painted;
}

}  // namespace metamer
