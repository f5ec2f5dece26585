#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/scene/render_scene.h"

/// A scene's lights on the GPU: as words, and as the shader text that reads them.
namespace metamer::gl {

/// The words of all lights, one after the other.
std::vector<std::uint32_t> light_words(const RenderScene& scene);

/// The lights of lights.def that the scene has and no others: their structs and functions, the
/// places of a light's words, `Incident incident(uint light, vec3 at)` and `float
/// solid_angle_of(uint light)`. Goes after prelude() (model_source.h).
std::string light_source(const RenderScene& scene);

}  // namespace metamer::gl
