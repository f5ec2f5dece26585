#pragma once

namespace metamer {

/// What the values of a spectrum may be, in any unit: sums over wavelengths, what these are divided
/// by, and products of two are finite and whole in f64. Where a spectrum is not 0 everywhere, its
/// largest value reaches the lower bound.
inline constexpr double least_peak = 1e-100, most_value = 1e100;

}  // namespace metamer
