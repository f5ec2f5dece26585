#pragma once

#include "server/scene/render_scene.h"

namespace metamer {

/// Y of a perfect white that faces the middle of a light with a surface of luminance 1, `distance`
/// (above 0) in front of it: E / π by Lambert's formulas. Of a sphere the distance is to its
/// middle.
double white_before(const RenderLight& light, double distance);

}  // namespace metamer
