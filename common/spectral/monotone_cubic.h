#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/spectral/spectrum.h"

namespace metamer {

/// A cubic between two samples, with one tangent at each, that rises and falls only where the
/// samples do and has its extrema at samples: so it stays between two neighbouring samples (M.
/// Steffen, "A simple method for monotonic interpolation in one dimension", Astronomy and
/// Astrophysics 239, 443, 1990, equations 2 to 11 and 24 to 29; the condition is F. N. Fritsch's
/// and R. E. Carlson's, 1980). Samples may be uneven. The result is the values at `nm`, which lie
/// between the first sample and the last; where one meets a sample, that sample's, to the bit.
/// Error: fewer than 3 samples.
Result<std::vector<double>> monotone_cubic(const Spectrum& samples, const std::vector<double>& nm);

/// What keeps it from being interpolated so, or nothing.
std::optional<std::string> monotone_cubic_fault(const Spectrum& samples);

}  // namespace metamer
