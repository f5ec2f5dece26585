#pragma once

#include <array>
#include <vector>

#include "common/problem.h"
#include "common/spectral/spectrum.h"

namespace metamer {

/// How true colours look under a light, CIE 13.3-1995.
struct RenderingIndex {
  double ra;                    ///< The mean of the first eight; at most 100.
  std::array<double, 15> each;  ///< R1 to R15, of TCS01 to TCS15.
  double kelvin;                ///< Of the reference: a black body below 5,000 K, else daylight.
  double distance;              ///< Of the light from the reference in CIE 1960 u, v.

  /// CIE 13.3, 5.3: with more, the light is so tinted that the numbers mean little.
  static constexpr double tolerance = 5.4e-3;
};

/// The indices of a light to the observer of 1931, 360 to 830 nm: where all its samples are at
/// multiples of 5 nm, sums over these, as the CIE takes them; else integrals, in which light and
/// test colours are straight lines between their samples. Errors: it is dark, or no black body of
/// 1,000 to 25,000 K is like it.
Result<RenderingIndex> rendering_index(const Spectrum& light);

}  // namespace metamer
