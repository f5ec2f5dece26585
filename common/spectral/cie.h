#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "common/spectral/observer.h"

/// The CIE's tables, embedded at build time from Debian's colord-data (5 nm; CIE 15), which the
/// binaries do not need.
namespace metamer::cie {

/// The observers of 2° and of 10°, 360 to 830 nm by 1 nm: Sprague's interpolation of the tables
/// (matching_function).
const Observer& observer_1931();
const Observer& observer_1964();

/// "A" "B" "C" "D50" "D55" "D65" "D75" "D93" "E" "F1" … "F12"; null when there is none of that
/// name.
const Spectrum* illuminant(std::string_view name);
const std::vector<std::string>& illuminant_names();

/// The 15 test colour samples of the colour rendering index, "TCS01" … "TCS15"; null if unknown.
const Spectrum* test_color(std::string_view name);
const std::vector<std::string>& test_color_names();

/// S₀, S₁, S₂, of which every phase of daylight is made, 300 to 830 nm (CIE 15:2004, table T.2).
const std::array<Spectrum, 3>& daylight_components();

}  // namespace metamer::cie
