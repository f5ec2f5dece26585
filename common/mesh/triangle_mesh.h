#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "common/mesh/array.h"

namespace metamer {

using Float2 = std::array<float, 2>;
using Float3 = std::array<float, 3>;
using Double3 = std::array<double, 3>;
using Triangle = std::array<std::uint32_t, 3>;

/// Where vertices are: as finely as their file says it. A survey's coordinates lie millions of
/// metres from their origin, where f32 has steps of half a metre.
class Positions {
 public:
  Positions() = default;
  // NOLINTBEGIN(google-explicit-constructor): one or the other is what positions are.
  Positions(Array<Float3> f32) : f32_(std::move(f32)) {}
  Positions(Array<Double3> f64) : f64_(std::move(f64)) {}
  // NOLINTEND(google-explicit-constructor)

  std::size_t size() const { return f32_.size() + f64_.size(); }
  bool empty() const { return size() == 0; }
  Double3 operator[](std::size_t i) const {
    if (!f64_.empty()) return f64_[i];
    const Float3& p = f32_[i];
    return {p[0], p[1], p[2]};
  }
  /// One of the two is empty.
  const Array<Float3>& f32() const { return f32_; }
  const Array<Double3>& f64() const { return f64_; }

 private:
  Array<Float3> f32_;
  Array<Double3> f64_;
};

/// Triangles in their own space, as a renderer takes them. All positions are finite, all indices
/// below their number.
struct TriangleMesh {
  Positions positions;
  Array<Float3> normals;  ///< One for each position, unit; 0: none there; empty: flat.
  /// One for each position, towards rising u; 0 where the file has no UVs; empty: nowhere, or no
  /// material asks.
  Array<Float3> tangents;
  /// One for each position, finite, v rising from the bottom of a picture; 0 where the file has
  /// none there; empty: it has none at all, or no material asks.
  Array<Float2> uvs;
  Array<Triangle> triangles;
  std::uint64_t skipped_faces = 0;  ///< Of its file: those without three corners.
  std::vector<std::string> notes;   ///< What users should know of how it was read.
};

}  // namespace metamer
