#pragma once

#include "common/color/seen_light.h"

namespace metamer {

/// Between which of these (rising, at least two) `x` lies: the lower one's number.
std::size_t place_in(const std::vector<double>& rising, double x);

/// Which share of a colour is seen where, at most.
class SeenShares {
 public:
  SeenShares(std::vector<double> grid, const std::vector<double>& share);

  /// Of all that lies between two wavelengths, and a little beyond to the grid's next places; above
  /// 0.
  double between(double from, double to) const;

 private:
  std::vector<double> grid_, until_;
};

/// What is seen of lights between the places of a grid.
class SeenAmounts {
 public:
  SeenAmounts(const std::vector<SeenLight>& lights, std::vector<double> grid);

  /// Of reflected light, by the reflectance at the places of the grid: the largest share under any
  /// of the lights of any of `axes` (0 to 2: X, Y, Z), relative to that and Y.
  SeenShares shares(const std::vector<double>& values, const std::vector<std::size_t>& axes) const;

 private:
  std::vector<double> grid_;
  std::vector<std::array<std::vector<double>, 3>> amounts_;  ///< By light and axis.
};

}  // namespace metamer
