#pragma once

#include "metamer/v1/plan.pb.h"
#include "server/scene/render_scene.h"

namespace metamer {

/// Fills in what the method needs for this scene: wavelengths, bands, and of a method that is made
/// for the scene, what was found; with notices where that is less than was asked for.
void plan_method(const RenderScene& scene, const v1::Settings& settings, v1::Plan& plan);

}  // namespace metamer
