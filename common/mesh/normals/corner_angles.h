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

inline double largest(double a, double b, double c) { return std::max(a, std::max(b, c)); }

/// The angle of a vector of this length from the x axis, rad in 0..π, where y >= 0: to 4e-8. As
/// twice the arctangent of y / (length + |x|), which is at most 1 (Abramowitz & Stegun
/// 1964, 4.4.49). Without branches, which no processor would foresee.
inline double angle_of(double x, double y, double length) {
  const double t = y / (length + std::abs(x)), s = t * t;
  const double high = ((0.0028662257 * s - 0.0161657367) * s + 0.0429096138) * s - 0.0752896400;
  const double low = ((high * s + 0.1065626393) * s - 0.1420889944) * s + 0.1999355085;
  const double half = t + t * s * (low * s - 0.3333314528);
  return M_PI / 2 - std::copysign(M_PI / 2 - 2 * half, x);
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
  const double size2 = dot(area, area), ab2 = dot(ab, ab), bc2 = dot(bc, bc), ca2 = dot(ca, ca);
  const double longest2 = largest(ab2, bc2, ca2);
  const double farthest = largest(std::abs(a[0]), std::abs(a[1]), std::abs(a[2])) * step;
  if (!(size2 > longest2 * std::max(1e-12 * longest2, farthest * farthest))) return {};
  const double size = std::sqrt(size2), scale = 1 / size;
  return {.normal = {area[0] * scale, area[1] * scale, area[2] * scale},
          .angles = {angle_of(-dot(ab, ca), size, std::sqrt(ab2 * ca2)),
                     angle_of(-dot(bc, ab), size, std::sqrt(bc2 * ab2)),
                     angle_of(-dot(ca, bc), size, std::sqrt(ca2 * bc2))}};
}

/// How a mesh's coordinates are rounded, relative to themselves.
inline double rounding_of(const MeshFile& mesh) {
  return mesh.positions_f64.empty() ? 0x1p-23 : 0x1p-52;
}

}  // namespace metamer
