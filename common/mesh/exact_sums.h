#pragma once

#include <atomic>
#include <cmath>
#include <cstdint>
#include <vector>

#include "common/mesh/triangle_mesh.h"

namespace metamer {

/// Sums of vectors that many threads add to. In fixed point, so that a sum depends neither on the
/// threads nor on the order.
class ExactSums {
 public:
  explicit ExactSums(std::size_t count) : sums_(count) {}

  /// Adds weight × `direction`, of length 1. The weights of a sum are below 2^27 together: the
  /// angles of limits::max_triangles.
  void add(std::size_t i, const Double3& direction, double weight) {
    for (std::size_t k = 0; k < 3; ++k)
      std::atomic_ref(sums_[i][k])
          .fetch_add(static_cast<std::int64_t>(std::nearbyint(direction[k] * weight * scale)),
                     std::memory_order_relaxed);
  }
  Double3 operator[](std::size_t i) const {
    const auto& sum = sums_[i];
    return {static_cast<double>(sum[0]), static_cast<double>(sum[1]), static_cast<double>(sum[2])};
  }

 private:
  static constexpr double scale = 0x1p35;  // Angles from 1e-5 on count to six digits.
  std::vector<std::array<std::int64_t, 3>> sums_;
};

}  // namespace metamer
