#include "common/scene/rough_mirror_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace metamer {

double rough_mirror_node(std::uint32_t i) {
  return deepest_rough_mirror * i / (rough_mirror_nodes - 1);
}

RoughMirrorPlace rough_mirror_place(float depth) {
  constexpr float last = rough_mirror_nodes - 1;
  const float at = std::min(depth * (last / static_cast<float>(deepest_rough_mirror)), last);
  const float below = std::min(std::floor(at), last - 1);
  return {static_cast<std::uint32_t>(below), at - below};
}

std::vector<double> rough_mirror(double depth, const std::vector<double>& nm) {
  std::vector<double> left;
  for (const double one : nm) {
    const double root = 4000 * std::numbers::pi * depth / one;
    left.push_back(std::exp(-root * root));
  }
  return left;
}

}  // namespace metamer
