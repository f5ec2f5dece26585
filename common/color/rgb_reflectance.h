#pragma once

#include "common/color/rgb_space.h"
#include "common/spectral/spectrum.h"

namespace metamer {

/// A smooth reflectance that is seen as a colour under D65 (2° observer): red, green and blue of
/// linear sRGB, 0..1 each, weigh three fixed reflectances, which are not negative and sum to 1. So
/// it lies in 0..1, and a neutral is the same at every wavelength. By 10 nm from 380 to 730 nm,
/// straight lines between. After the idea of I. Mallett and C. Yuksel, "Spectral Primary
/// Decomposition for Rendering with sRGB Reflectance", EGSR 2019. rgb_reflectance.py computed the
/// three. A picture has no more than three numbers of a surface: under another light this one looks
/// as a surface of that colour may, and not as the one that was meant.
Spectrum reflectance_of_rgb(const Rgb& linear);

}  // namespace metamer
