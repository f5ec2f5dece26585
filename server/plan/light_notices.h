#pragma once

#include "metamer/v1/plan.pb.h"
#include "server/plan/features.h"

namespace metamer {

/// Says of lights with a surface and of environments how many points of them a pixel looks at, and
/// what of the scene means nothing to them. The plan has its numbers of samples.
void notice_lights(const RenderScene& scene, const std::vector<Need>& needs, v1::Plan& plan);

}  // namespace metamer
