#pragma once

#include <cmath>
#include <cstdint>

#include "common/mesh/triangle_mesh.h"

namespace metamer {

/// A sum of vectors in fixed point: it does not depend on their order.
class ExactSum {
 public:
  /// Adds weight × `direction`, of length 1. The weights of a sum are below 2^27 together: the
  /// angles of limits::max_triangles.
  void add(const Double3& direction, double weight) {
    for (std::size_t k = 0; k < 3; ++k)
      sum_[k] += static_cast<std::int64_t>(direction[k] * weight * scale);
  }
  /// Of any length.
  Double3 value() const {
    return {static_cast<double>(sum_[0]), static_cast<double>(sum_[1]),
            static_cast<double>(sum_[2])};
  }

 private:
  static constexpr double scale = 0x1p35;  // Angles from 1e-5 on count to six digits.
  std::array<std::int64_t, 3> sum_{};
};

}  // namespace metamer
