#pragma once

#include <string>

#include "common/color/rgb_space.h"

namespace metamer {

/// An ICC profile (ICC.1:2010, version 4.3) that says what numbers in this space mean: a display
/// profile of matrix and curves, adapted to the profile's D50 by Bradford's matrix. Its bytes
/// depend on nothing else.
std::string icc_profile(const RgbSpace& space, bool linear);

}  // namespace metamer
