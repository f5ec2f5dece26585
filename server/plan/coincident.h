#pragma once

#include "metamer/v1/plan.pb.h"
#include "server/scene/render_scene.h"

namespace metamer {

/// Adds a notice where quads, and quads and planes, lie in each other's plane and overlap: which of
/// them a ray meets first is up to rounding, pixel by pixel. Clear ones are passed together
/// (server/cpu/media.h) and have none.
void notice_coincident(const RenderScene& scene, v1::Plan& plan);

}  // namespace metamer
