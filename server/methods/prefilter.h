#pragma once

#include "server/methods/method.h"

/// Colour pre-filtering, 3.3.2 and 4.3 (G. Ward and E. Eydelberg-Vileshin, Eurographics Workshop on
/// Rendering 2002): three values, made from full spectra before rendering. A surface has the colour
/// that it shows under the dominant light, relative to that light, so that what has no colour of
/// its own is neutral over any number of mirrors. Lights follow the source's three rules, with the
/// dominant light as their white and unit: it is 1, 1, 1; its like is grey; another is its own
/// colour. Direct light of the dominant kind is right; the rest is as wrong as three values are.
namespace metamer {

std::unique_ptr<Method> make_prefilter(const v1::Plan& plan, const RenderScene& scene);

/// Says where the dominant light is not the scene's first, and where it has no colour that three
/// linear sRGB values can stand for: then X, Y and Z are filtered in their place.
void plan_prefilter(const RenderScene& scene, const v1::Settings& settings, v1::Plan& plan);

}  // namespace metamer
