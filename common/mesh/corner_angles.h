#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "common/mesh/vertex.h"

namespace metamer {

inline Double3 operator-(const Double3& a, const Double3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline double dot(const Double3& a, const Double3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Double3 cross(const Double3& a, const Double3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The angle of a vector from the x axis, rad in 0..π, where y >= 0: to 2e-8 (Abramowitz & Stegun
/// 1964, 4.4.49).
inline double angle_of(double y, double x) {
  const double run = std::abs(x);
  const bool steep = y > run;
  const double t = (steep ? run : y) / (steep ? y : run), s = t * t;
  double angle = 0.0028662257;
  for (const double c : {-0.0161657367, 0.0429096138, -0.0752896400, 0.1065626393, -0.1420889944,
                         0.1999355085, -0.3333314528, 1.0})
    angle = angle * s + c;
  angle *= t;
  if (steep) angle = M_PI / 2 - angle;
  return x < 0 ? M_PI - angle : angle;
}

/// A triangle's plane and the angles of its corners.
struct CornerAngles {
  Double3 normal{};                ///< Unit; 0 where the triangle spans no area,
  std::array<double, 3> angles{};  ///< rad; and these.
};

/// Of the triangle a b c, whose coordinates are rounded to `step` of themselves. One no higher than
/// its coordinates' rounding, or than a millionth of its longest side, spans no area: its plane
/// would be that of rounding errors, and the angle of its middle corner the largest of all.
inline CornerAngles corner_angles(const Double3& a, const Double3& b, const Double3& c,
                                  double step) {
  const Double3 ab = b - a, bc = c - b, ca = a - c;
  const Double3 area = cross(ab, bc);
  const double size2 = dot(area, area);
  const double longest2 = std::max({dot(ab, ab), dot(bc, bc), dot(ca, ca)});
  const double farthest = std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])}) * step;
  if (!(size2 > longest2 * std::max(1e-12 * longest2, farthest * farthest))) return {};
  const double size = std::sqrt(size2), scale = 1 / size;
  return {.normal = {area[0] * scale, area[1] * scale, area[2] * scale},
          .angles = {angle_of(size, -dot(ab, ca)), angle_of(size, -dot(bc, ab)),
                     angle_of(size, -dot(ca, bc))}};
}

/// How a mesh's coordinates are rounded, relative to themselves.
inline double rounding_of(const MeshFile& mesh) {
  return mesh.positions_f64.empty() ? 0x1p-23 : 0x1p-52;
}

}  // namespace metamer
