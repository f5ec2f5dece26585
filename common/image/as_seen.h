#pragma once

#include "common/color/rgb_space.h"

namespace metamer {

/// RGB → X Y Z as a screen of D65 shows it: the white of the space becomes D65 (white_for_d65, and
/// its error).
inline Result<Matrix3> as_seen(const RgbSpace& space) {
  return white_for_d65(space).map(
      [&](const Matrix3& white) { return multiply(invert(white), space.to_xyz); });
}

}  // namespace metamer
