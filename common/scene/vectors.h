#pragma once

#include <cmath>

#include "metamer/v1/geometry.pb.h"

/// The little geometry that validation needs, f64.
namespace metamer {

struct Vector {
  double x = 0, y = 0, z = 0;
};

inline Vector to_vector(const v1::Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Neither overflows nor underflows on the way.
inline double length(Vector v) { return std::hypot(v.x, v.y, v.z); }
/// `v` must not be 0.
inline Vector unit(Vector v) {
  const double l = length(v);
  return {v.x / l, v.y / l, v.z / l};
}

/// Sine of the angle below which two directions count as parallel: f32 renderers can't tell.
inline constexpr double parallel_sine = 1e-6;

/// Both must not be 0.
inline bool are_parallel(Vector a, Vector b) {
  return length(cross(unit(a), unit(b))) < parallel_sine;
}

}  // namespace metamer
