#include "common/spectral/panels.h"

#include <cmath>
#include <numbers>

namespace metamer {

std::vector<double> panel_nodes(double from, double to, std::size_t degree) {
  std::vector<double> nm(degree + 1);
  for (std::size_t i = 0; i <= degree; ++i)
    nm[i] = (from + to) / 2 -
            (to - from) / 2 *
                std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(degree));
  nm.front() = from;
  nm.back() = to;
  return nm;
}

std::vector<double> Panels::nodes() const {
  std::vector<double> nm = {edges.front()};
  for (std::size_t p = 0; p < degree.size(); ++p) {
    const std::vector<double> own = panel_nodes(edges[p], edges[p + 1], degree[p]);
    nm.insert(nm.end(), own.begin() + 1, own.end());
  }
  return nm;
}

Lagrange lagrange(double nm, std::span<const double> nodes) {
  // The barycentric formula, whose weights are 1 and −1 in turn, halves at the ends.
  Lagrange worth{};
  const std::size_t last = nodes.size() - 1;
  double sum = 0;
  for (std::size_t i = 0; i <= last; ++i) {
    const double distance = nm - nodes[i];
    if (distance == 0) {
      worth = {};
      worth[i] = 1;
      return worth;
    }
    worth[i] = (i % 2 == 0 ? 1 : -1) * (i == 0 || i == last ? 0.5 : 1) / distance;
    sum += worth[i];
  }
  for (std::size_t i = 0; i <= last; ++i) worth[i] /= sum;
  return worth;
}

}  // namespace metamer
