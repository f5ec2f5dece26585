#pragma once

#include <optional>

#include "metamer/v1/plan.pb.h"
#include "server/cpu/embree_scene.h"
#include "server/render/probe.h"

namespace metamer::cpu {

/// What the plan's picture shows in the middle of a pixel; nothing: the eye meets nothing there.
std::optional<SeenPoint> look(const RenderScene& scene, const EmbreeScene& geometry,
                              const v1::Plan& plan, std::uint32_t x, std::uint32_t y);

}  // namespace metamer::cpu
