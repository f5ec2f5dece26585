#pragma once

#include "server/methods/method.h"

namespace metamer {

/// Point sampling (4.2), E[3.2-2] and E[3.2-4]: a value at each wavelength of the plan, which is
/// uniform, listed or fitted.
std::unique_ptr<Method> make_point(const v1::Plan& plan, const RenderScene& scene);

/// The same at any positions with weights, the lights' samples there.
std::unique_ptr<Method> make_sampled(const Wavelengths& wavelengths, const Observer& observer,
                                     const RenderScene& scene);

/// How many wavelengths there are, and what lights are at them: where that is left open, whichever
/// gets the largest difference from the scene's true colours (DirectColors) down. Of a fitted one,
/// which wavelengths.
void plan_point(const RenderScene& scene, const v1::Settings& settings, v1::Plan& plan);

Wavelengths wavelengths_of_point(const v1::Method& method);

}  // namespace metamer
