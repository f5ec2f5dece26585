#pragma once

#include <array>

#include "common/color/xyz.h"

/// IEC 61966-2-1 (sRGB). Its white is D65, x 0.3127, y 0.3290.
namespace metamer::srgb {

using Rgb = std::array<double, 3>;
using Matrix3 = std::array<std::array<double, 3>, 3>;  ///< Rows.

/// Linear RGB → XYZ, derived from the primaries and the white; and its inverse.
const Matrix3& to_xyz_matrix();
const Matrix3& from_xyz_matrix();

Rgb from_xyz(const Xyz& xyz);  ///< Linear; may be negative or above 1: out of gamut.
Xyz to_xyz(const Rgb& linear);

/// The transfer function, linear → encoded, on [0, 1]; odd for negative values, and continued
/// above 1, so that it has an inverse everywhere.
double encode(double linear);
double decode(double encoded);

}  // namespace metamer::srgb
