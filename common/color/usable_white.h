#pragma once

#include "common/color/xyz.h"

namespace metamer {

/// The white that ΔE needs: equal energy where `white` has next to none of X, Y or Z.
Xyz usable_white(const Xyz& white);

}  // namespace metamer
