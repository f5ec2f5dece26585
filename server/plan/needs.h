#pragma once

#include "metamer/v1/plan.pb.h"
#include "server/plan/plan.h"
#include "server/scene/render_scene.h"

namespace metamer {

/// Writes into the plan, a sentence each, what the scene needs and why (Plan.need), and what is
/// left out because nothing needs it (Plan.unneeded). The plan's depth is known.
void list_needs(const RenderScene& scene, const Capabilities& capabilities, v1::Plan& plan);

}  // namespace metamer
