#pragma once

#include "common/color/rgb_space.h"

/// The false colours of differences.
namespace metamer {

/// D. A. Green, A colour scheme for the display of astronomical intensity images, Bulletin of the
/// Astronomical Society of India 39, 289 (2011), with its usual parameters: encoded sRGB from black
/// at 0 to white at 1, ever lighter.
Rgb cubehelix(double level);

/// Of a value on a scale from 0 to `top`: white above it, red where it is not finite.
Rgb ramp_color(double value, double top);

/// The end of a scale: 1, 2 or 5 and zeros, at or above `value`; 1 where there is nothing to show.
double scale_end(double value);

}  // namespace metamer
