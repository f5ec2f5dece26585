#pragma once

#include "common/color/rgb_space.h"

/// sRGB (IEC 61966-2-1), which previews and the method `rgb` work in: short names for one
/// rgb_space.
namespace metamer::srgb {

using metamer::Matrix3;
using metamer::Rgb;

inline const RgbSpace& space() {
  static const RgbSpace& srgb = rgb_space(StandardSpace::srgb);
  return srgb;
}

/// Linear RGB → XYZ, and its inverse.
inline const Matrix3& to_xyz_matrix() { return space().to_xyz; }
inline const Matrix3& from_xyz_matrix() { return space().from_xyz; }

/// Linear; may be negative or above 1: out of gamut.
inline Rgb from_xyz(const Xyz& xyz) { return multiply(from_xyz_matrix(), xyz); }
inline Xyz to_xyz(const Rgb& linear) { return multiply(to_xyz_matrix(), linear); }

inline double encode(double linear) { return metamer::encode(space().transfer, linear); }
inline double decode(double encoded) { return metamer::decode(space().transfer, encoded); }

}  // namespace metamer::srgb
