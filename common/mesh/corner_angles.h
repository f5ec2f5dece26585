#pragma once

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
  const double size = std::sqrt(dot(area, area));
  const double longest = std::sqrt(std::max({dot(ab, ab), dot(bc, bc), dot(ca, ca)}));
  const double farthest = std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
  if (!(size > longest * std::max(1e-6 * longest, step * farthest))) return {};
  const double at_a = std::atan2(size, -dot(ab, ca)), at_b = std::atan2(size, -dot(bc, ab));
  return {.normal = {area[0] / size, area[1] / size, area[2] / size},
          .angles = {at_a, at_b, std::max(0.0, M_PI - at_a - at_b)}};
}

/// How a mesh's coordinates are rounded, relative to themselves.
inline double rounding_of(const MeshFile& mesh) {
  return mesh.positions_f64.empty() ? 0x1p-23 : 0x1p-52;
}

}  // namespace metamer
