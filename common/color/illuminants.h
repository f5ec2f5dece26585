#pragma once

#include <string_view>

#include "common/problem.h"
#include "common/spectral/spectrum.h"

namespace metamer {

/// A light by its name: one of the CIE's tables ("D65", cie::illuminant_names), a phase of daylight
/// ("D:6504K", 4,000 to 25,000 K, CIE 15), or a black body ("2856K", coldest_kelvin to
/// hottest_kelvin). Errors: no such name (with "did you mean"), a temperature out of range.
Result<Spectrum> illuminant_named(std::string_view name);

/// Whether a name is that of daylight or a black body, at a temperature that may be out of range.
bool names_temperature(std::string_view name);

/// A black body that is colder has no light that f64 could hold beside its red; one that is hotter
/// has the colour of this one.
inline constexpr double coldest_kelvin = 500, hottest_kelvin = 1e6;

}  // namespace metamer
