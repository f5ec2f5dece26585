#pragma once

#include <optional>

#include "common/problem.h"
#include "server/scene/render_scene.h"

namespace metamer {

/// Gives each mesh of `placed` that one of the lights shines from its RenderObject::area_up_to;
/// takes time with each of its triangles. Error: a surface without any area, with the light's
/// field.
std::optional<Problem> find_shining(const std::vector<RenderLight>& lights, RenderScene& placed);

}  // namespace metamer
