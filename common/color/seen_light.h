#pragma once

#include "common/color/xyz.h"

namespace metamer {

/// What an observer sees of a light whose luminance is made 1, wavelength by wavelength.
struct SeenLight {
  /// Cells within which light and observer are lines and whatever has its edges at `edges` (rising)
  /// is smooth: four points of Gauss and Legendre in each. All 0 where the light is dark.
  SeenLight(const Observer& observer, const Spectrum& emission, const std::vector<double>& edges);

  Wavelengths cells;
  std::array<std::vector<double>, 3> density;  ///< Of X, Y, Z, 1/nm, at `cells`.
};

}  // namespace metamer
