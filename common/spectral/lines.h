#pragma once

#include <vector>

#include "common/spectral/spectrum.h"

namespace metamer {

/// A line of a gas discharge or a laser, narrower than anything that reflects it.
struct Line {
  double nm;     ///< Above 0.
  double power;  ///< Of the whole line: what an emission's values are, times nm.
};

/// An emission with lines, in any order: each is a triangle, line_half_width to either side.
/// `continuum` may have no samples; beyond them there are only the lines.
Spectrum with_lines(const Spectrum& continuum, const std::vector<Line>& lines);

inline constexpr double line_half_width = 1e-3;  ///< nm; over which no observer changes by 1e-4.

/// An emission of one sample has no width, and so no light: it is a line.
Spectrum as_emission(Spectrum spectrum);

}  // namespace metamer
