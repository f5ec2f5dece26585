#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/scene/render_scene.h"
#include "server/transport/factor_rows.h"

/// A scene's materials on the GPU: as words, and as the shader text that reads them.
namespace metamer::gl {

/// The words of all materials, one after the other.
std::vector<std::uint32_t> material_words(const RenderScene& scene, const FactorRows& rows);

/// The models of the scene and no others (model_source.h), the places of a material's words, and
/// `Lobes reflection(uint base, Angles angles)`: its model at a point, `base` its first word. Goes
/// before gather.glsl, and after the buffer `word_of`, which it declares.
std::string material_source(const RenderScene& scene);

}  // namespace metamer::gl
