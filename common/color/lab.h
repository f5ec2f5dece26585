#pragma once

#include "common/color/xyz.h"

/// CIE 1976 L*a*b* and L*u*v*, and differences in them. The white is the XYZ of what looks white;
/// its luminance is part of it.
namespace metamer {

struct Lab {
  double l, a, b;
};

struct Luv {
  double l, u, v;
};

/// CIE 15:2004, 8.2.1, with the exact 216/24389 and 841/108. Components of `white` are above 0.
Lab to_lab(const Xyz& xyz, const Xyz& white);
Luv to_luv(const Xyz& xyz, const Xyz& white);

double delta_e_ab(const Lab& one, const Lab& other);  ///< ΔE*ab, CIE 1976.
double delta_e_uv(const Luv& one, const Luv& other);  ///< ΔE*uv, CIE 1976: the source's.

/// ΔE00: CIEDE2000 as G. Sharma, W. Wu and E. N. Dalal write it, Color Research and Application 30,
/// 21 (2005); k_L = k_C = k_H = 1.
double delta_e_00(const Lab& one, const Lab& other);

}  // namespace metamer
