#pragma once

#include "common/color/xyz.h"
#include "metamer/v1/plan.pb.h"
#include "server/scene/render_scene.h"

namespace metamer {

/// Σ ȳ Φ Δλ at sample positions by ∫ ȳ Φ dλ: 1 where they see all of a light's luminance, 0 where
/// it lies between them, above 1 where a line falls on one and fills its cell. 1 where there is
/// nothing to see. The integral is exact: both functions are linear between their samples.
double seen_share(const Spectrum& emission, cie::Observer observer, const Wavelengths& wavelengths);

/// Adds a notice for each light of whose luminance the positions miss or add more than 2 %: it
/// keeps its luminance (E[3.2-4]), so what they miss is missing from its colour. And for each
/// property whose luminance under equal energy they see more than a tenth of it wrong.
void notice_missed_light(const RenderScene& scene, const v1::Settings& settings,
                         const Wavelengths& wavelengths, v1::Plan& plan);

}  // namespace metamer
