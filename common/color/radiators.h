#pragma once

#include <vector>

#include "common/spectral/spectrum.h"

/// The lights that others are compared with; relative power.
namespace metamer {

/// Planck's law, c₂ = 1.4388e-2 m·K (that of ITS-90 as the CIE rounds it; illuminant A, which was
/// 2848 K with the older 1.4350e-2, is 2856 K with it), 1 at 560 nm. `kelvin` is above 0.
Spectrum planckian(double kelvin, std::vector<double> nm);

/// A phase of daylight from its temperature, CIE 15:2004, 3.1: at most 25,000 K and at least 4,000
/// K; 1 at 560 nm. Outside 300 to 830 nm it is 0.
Spectrum daylight(double kelvin, std::vector<double> nm);

/// Of the components of daylight (CIE 15:2004, 3.1) what has a chromaticity of the 1931 observer,
/// up to a factor: of x and y in linear terms, so that spectra at the corners of a triangle weigh
/// all that lie in it. Of x and y that no daylight has it may be below 0 somewhere.
Spectrum daylight_of(double x, double y);

}  // namespace metamer
