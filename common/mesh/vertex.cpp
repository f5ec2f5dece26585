#include "common/mesh/vertex.h"

#include <algorithm>

namespace metamer {

bool needs_f64(const std::vector<Double3>& positions) {
  double farthest = 0, side = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double low = limits::max_coordinate, high = -limits::max_coordinate;
    for (const Double3& p : positions) {
      low = std::min(low, p[k]);
      high = std::max(high, p[k]);
    }
    farthest = std::max({farthest, std::abs(low), std::abs(high)});
    side = std::max(side, high - low);
  }
  return !positions.empty() && farthest > 16 * side;
}

}  // namespace metamer
