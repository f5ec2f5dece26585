#pragma once

#include "server/methods/method.h"

namespace metamer {

/// The naive trichromatic way: every spectrum is reduced to linear sRGB before rendering, a light
/// by its own power, a surface by its colour under D65, and reflection multiplies R, G and B. Right
/// only where all lights are D65; kept as the thing to beat.
std::unique_ptr<Method> make_rgb(const v1::Plan& plan, const RenderScene& scene);

}  // namespace metamer
