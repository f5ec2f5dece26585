#pragma once

#include "server/scene/render_scene.h"

namespace metamer {

/// The same scene with the eye at the origin, and its size between 1 and 2 by a power of two. f32
/// is finest around the origin and Embree multiplies coordinates three deep, so a picture then
/// depends neither on where in the world it is taken nor on the unit of length.
RenderScene to_camera_space(RenderScene scene);

}  // namespace metamer
