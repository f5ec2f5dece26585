#include "common/color/seen_shares.h"

#include <algorithm>
#include <cmath>

namespace metamer {

std::size_t place_in(const std::vector<double>& rising, double x) {
  const auto above = std::upper_bound(rising.begin() + 1, rising.end() - 1, x);
  return static_cast<std::size_t>(above - rising.begin()) - 1;
}

SeenShares::SeenShares(std::vector<double> grid, const std::vector<double>& share)
    : grid_(std::move(grid)), until_{0} {
  for (const double one : share) until_.push_back(until_.back() + one);
}

double SeenShares::between(double from, double to) const {
  const auto end = std::lower_bound(grid_.begin(), grid_.end() - 1, to) - grid_.begin();
  return std::max(1e-9, until_[static_cast<std::size_t>(end)] - until_[place_in(grid_, from)]);
}

SeenAmounts::SeenAmounts(const std::vector<SeenLight>& lights, std::vector<double> grid)
    : grid_(std::move(grid)) {
  for (const SeenLight& light : lights) {
    auto& amount = amounts_.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      amount[axis].assign(grid_.size() - 1, 0);
      std::size_t i = 0;
      for (std::size_t k = 0; k < light.cells.size(); ++k) {
        while (i + 2 < grid_.size() && light.cells.nm()[k] > grid_[i + 1]) ++i;
        amount[axis][i] += std::abs(light.density[axis][k] * light.cells.widths()[k]);
      }
    }
  }
}

SeenShares SeenAmounts::shares(const std::vector<double>& values,
                               const std::vector<std::size_t>& axes) const {
  std::vector<double> share(grid_.size() - 1);
  const auto at = [&](std::size_t i) { return (values[i] + values[i + 1]) / 2; };
  for (const auto& amount : amounts_)
    for (const std::size_t axis : axes) {
      double all = 0;
      for (std::size_t i = 0; i < share.size(); ++i)
        all += at(i) * (amount[1][i] + amount[axis][i]);
      if (!(all > 0)) continue;
      for (std::size_t i = 0; i < share.size(); ++i)
        share[i] = std::max(share[i], at(i) * amount[axis][i] / all);
    }
  return SeenShares(grid_, share);
}

}  // namespace metamer
