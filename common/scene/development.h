#pragma once

#include "common/color/adaptation.h"
#include "common/color/rgb_space.h"
#include "common/problem.h"
#include "metamer/v1/scene.pb.h"

/// The messages of a development as the colour library's own values.
namespace metamer {

/// The message's values are known.
Adaptation to_adaptation(v1::Adaptation adaptation);
StandardSpace to_standard_space(v1::RgbSpace space);

/// The space that a development names, sRGB when it names none. Errors, with the field inside the
/// development ("primaries.red"): those of make_rgb_space, a chromaticity that has not two numbers.
Result<RgbSpace> to_rgb_space(const v1::Development& development);

}  // namespace metamer
