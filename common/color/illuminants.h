#pragma once

#include <cstddef>
#include <string_view>

#include "common/problem.h"
#include "common/spectral/spectrum.h"

namespace metamer {

/// A light by its name: one of the CIE's tables ("D65", cie::illuminant_names), a phase of daylight
/// ("D:6504K", 4,000 to 25,000 K, CIE 15), a black body ("2856K", coldest_kelvin to
/// hottest_kelvin), sunlight by turbidity and elevation ("sun:3:45", sunlight.h), or lines with
/// their powers, 1 where none is said ("436nm:0.6+546.1nm", between 360 and 830 nm, at most
/// most_lines). Errors: no such name (with "did you mean"), a temperature or a line out of range.
Result<Spectrum> illuminant_named(std::string_view name);

/// Whether a name is meant for daylight, a black body or lines: it may be out of range, or lack a
/// unit, which illuminant_named says.
bool names_formula(std::string_view name);

/// A black body that is colder has no light that f64 could hold beside its red; one that is hotter
/// has the colour of this one.
inline constexpr double coldest_kelvin = 500, hottest_kelvin = 1e6;

/// As a scene's spectrum may have.
inline constexpr std::size_t most_lines = 256;

}  // namespace metamer
