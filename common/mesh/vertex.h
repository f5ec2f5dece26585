#pragma once

#include <cmath>
#include <limits>

#include "common/mesh/mesh_file.h"
#include "common/scene/limits.h"

/// What a vertex's numbers become, however their file writes them.
namespace metamer {

inline bool is_position(const Double3& p) {
  constexpr double most = limits::max_coordinate;  // NaN is no position, either.
  return std::abs(p[0]) <= most && std::abs(p[1]) <= most && std::abs(p[2]) <= most;
}

inline Float3 to_f32(const Double3& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

inline Double3 position(const MeshFile& mesh, std::size_t i) {
  if (!mesh.positions_f64.empty()) return mesh.positions_f64[i];
  const Float3& p = mesh.positions[i];
  return {p[0], p[1], p[2]};
}
inline std::size_t vertex_count(const MeshFile& mesh) {
  return mesh.positions.size() + mesh.positions_f64.size();
}

/// Whether f32 would move vertices by more than the 1,000,000th of what they span: where they lie
/// further from the origin than 16 times their largest side. Of a text, which says no precision.
bool needs_f64(const std::vector<Double3>& positions);

/// A direction of length 1; 0 where it has none.
inline Float3 unit_or_none(const Double3& v) {
  const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  if (!(length > 1e-150 && length < 1e150)) return {};
  return to_f32({v[0] / length, v[1] / length, v[2] / length});
}

/// Of a vertex that the file gives no UV.
inline constexpr Float2 no_uv{std::numeric_limits<float>::quiet_NaN(),
                              std::numeric_limits<float>::quiet_NaN()};
inline Float2 to_uv(double u, double v) { return {static_cast<float>(u), static_cast<float>(v)}; }
inline bool is_uv(const Float2& uv) { return std::isfinite(uv[0]) && std::isfinite(uv[1]); }

}  // namespace metamer
