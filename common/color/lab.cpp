#include "common/color/lab.h"

#include <cmath>
#include <numbers>

namespace metamer {
namespace {

constexpr double degree = std::numbers::pi / 180;

double lab_root(double t) {
  constexpr double epsilon = 216.0 / 24389, slope = 841.0 / 108;
  return t > epsilon ? std::cbrt(t) : slope * t + 4.0 / 29;
}

/// The 1976 chromaticity; that of black is the white's, so that it has no colour.
std::array<double, 2> chromaticity_76(const Xyz& xyz, const Xyz& otherwise) {
  const double sum = xyz[0] + 15 * xyz[1] + 3 * xyz[2];
  if (sum == 0) return chromaticity_76(otherwise, {1, 1, 1});
  return {4 * xyz[0] / sum, 9 * xyz[1] / sum};
}

/// The angle of (x, y) in degrees, 0 to 360; 0 for (0, 0).
double hue(double x, double y) {
  if (x == 0 && y == 0) return 0;
  const double angle = std::atan2(y, x) / degree;
  return angle < 0 ? angle + 360 : angle;
}

/// The difference of two hues, −180 to 180; 0 where one of the colours has none.
double hue_difference(double from, double to, bool grey) {
  if (grey) return 0;
  const double difference = to - from;
  if (difference > 180) return difference - 360;
  return difference < -180 ? difference + 360 : difference;
}

double mean_hue(double one, double other, bool grey) {
  if (grey) return one + other;
  if (std::abs(one - other) <= 180) return (one + other) / 2;
  return one + other < 360 ? (one + other + 360) / 2 : (one + other - 360) / 2;
}

double square(double x) { return x * x; }

}  // namespace

Lab to_lab(const Xyz& xyz, const Xyz& white) {
  const double x = lab_root(xyz[0] / white[0]), y = lab_root(xyz[1] / white[1]),
               z = lab_root(xyz[2] / white[2]);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Luv to_luv(const Xyz& xyz, const Xyz& white) {
  const double l = 116 * lab_root(xyz[1] / white[1]) - 16;
  const auto own = chromaticity_76(xyz, white), of_white = chromaticity_76(white, white);
  return {l, 13 * l * (own[0] - of_white[0]), 13 * l * (own[1] - of_white[1])};
}

double delta_e_ab(const Lab& one, const Lab& other) {
  return std::hypot(one.l - other.l, one.a - other.a, one.b - other.b);
}

double delta_e_uv(const Luv& one, const Luv& other) {
  return std::hypot(one.l - other.l, one.u - other.u, one.v - other.v);
}

double delta_e_00(const Lab& one, const Lab& other) {
  // Stretch a where the colours are near grey.
  const double mean_chroma = (std::hypot(one.a, one.b) + std::hypot(other.a, other.b)) / 2;
  const double seventh = std::pow(mean_chroma, 7);
  constexpr double of_25 = 6103515625;  // 25⁷
  const double stretch = 1.5 - 0.5 * std::sqrt(seventh / (seventh + of_25));
  const double a1 = stretch * one.a, a2 = stretch * other.a;
  const double chroma1 = std::hypot(a1, one.b), chroma2 = std::hypot(a2, other.b);
  const double hue1 = hue(a1, one.b), hue2 = hue(a2, other.b);
  const bool grey = chroma1 * chroma2 == 0;

  // The differences of lightness, chroma and hue.
  const double lightness = other.l - one.l, chroma = chroma2 - chroma1;
  const double turned =
      2 * std::sqrt(chroma1 * chroma2) * std::sin(hue_difference(hue1, hue2, grey) / 2 * degree);

  // How much each of them counts there.
  const double l = (one.l + other.l) / 2, c = (chroma1 + chroma2) / 2;
  const double h = mean_hue(hue1, hue2, grey);
  const double t = 1 - 0.17 * std::cos((h - 30) * degree) + 0.24 * std::cos(2 * h * degree) +
                   0.32 * std::cos((3 * h + 6) * degree) - 0.20 * std::cos((4 * h - 63) * degree);
  const double of_l = 1 + 0.015 * square(l - 50) / std::sqrt(20 + square(l - 50));
  const double of_c = 1 + 0.045 * c, of_h = 1 + 0.015 * c * t;
  const double c7 = std::pow(c, 7);
  const double rotation =
      -2 * std::sqrt(c7 / (c7 + of_25)) * std::sin(60 * std::exp(-square((h - 275) / 25)) * degree);
  return std::sqrt(square(lightness / of_l) + square(chroma / of_c) + square(turned / of_h) +
                   rotation * (chroma / of_c) * (turned / of_h));
}

}  // namespace metamer
