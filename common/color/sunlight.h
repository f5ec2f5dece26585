#pragma once

#include "common/spectral/spectrum.h"

namespace metamer {

/// What turbidities and elevations the sky by day is known for; elevations in degrees.
inline constexpr double least_turbidity = 2, most_turbidity = 10, usual_turbidity = 3;
inline constexpr double most_elevation = 90, usual_elevation = 45;

/// Sunlight on its way through the air, 380 to 780 nm, relative power: A. J. Preetham, P. Shirley
/// and B. Smits, "A Practical Analytic Model for Daylight" (SIGGRAPH 1999), A.1, of 0.35 cm of
/// ozone and 2 cm of water vapour. Its tables are those of M. Iqbal, An Introduction to Solar
/// Radiation (1983); from 750 nm on, where they have no sun, it is a black body of 5,778 K. Within
/// the ranges above; the elevation (degrees) is that of the sun's middle.
Spectrum sunlight(double turbidity, double elevation);

}  // namespace metamer
