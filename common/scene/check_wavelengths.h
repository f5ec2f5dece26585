#pragma once

#include <string>
#include <vector>

#include "common/scene/findings.h"

namespace metamer {

/// Adds what is wrong with a list of wavelengths (nm) in `field`: too many, out of
/// limits::min_wavelength..max_wavelength, unsorted, repeated. True when it is sound.
bool check_wavelengths(const std::vector<double>& nm, const std::string& field, Findings& findings);

}  // namespace metamer
