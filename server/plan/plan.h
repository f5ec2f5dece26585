#pragma once

#include "metamer/v1/plan.pb.h"
#include "server/scene/render_scene.h"

namespace metamer {

/// What a worker's machine can do.
struct Capabilities {
  unsigned threads;
};

/// What the scene needs and what will be done, from the compiled scene and its settings
/// (defaults filled in, validated). A pure function; the plan is not changed afterwards.
v1::Plan make_plan(const RenderScene& scene, const v1::Settings& settings,
                   const Capabilities& capabilities);

}  // namespace metamer
