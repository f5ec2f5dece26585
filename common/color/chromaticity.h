#pragma once

#include <optional>

#include "common/color/xyz.h"

/// Where a colour lies when its brightness is left aside, and which black body it looks like.
namespace metamer {

/// CIE 1931 x, y.
struct Chromaticity {
  double x, y;
};

/// The coordinates of a uniform scale: u, v of 1960, or u', v' of 1976.
struct Uv {
  double u, v;
};

/// x = X / (X + Y + Z), and so on. Nothing where that sum is not above 0: black has no
/// chromaticity.
std::optional<Chromaticity> chromaticity(const Xyz& xyz);

Uv uv_1960(const Chromaticity& c);  ///< u = 4x / (12y − 2x + 3), v = 6y / (…).
Uv uv_1976(const Chromaticity& c);  ///< u' = u, v' = 1.5 v.

/// A colour's place beside the Planckian locus.
struct ColorTemperature {
  double kelvin;
  double duv;  ///< Distance in CIE 1960 u, v; above 0: greener than the black body.
};

/// Correlated colour temperature, 1,000 K to 1,000,000 K: the black body that lies nearest in CIE
/// 1960 u, v (CIE 15:2004, 9.5), found by minimising that distance to the locus itself, which is
/// computed from Planck's law and the 1931 observer. Within 1e-3 K at 10,000 K. Nothing beyond
/// either end, and where |Duv| > 0.05, for there the CIE gives it no meaning.
std::optional<ColorTemperature> color_temperature(const Chromaticity& c);

}  // namespace metamer
