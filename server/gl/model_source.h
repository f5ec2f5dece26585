#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "common/models/registry.h"

/// The shared sources as GLSL.
namespace metamer::gl {

/// A file of shaders/, embedded at build time: "models/lobes.glsl". Empty: there is no such file.
std::string_view shader_text(std::string_view path);

/// "#version 450", Real, Vec3, Bool, and the functions that GLSL lacks or drivers compute coarsely:
/// what every program begins with.
std::string prelude();

/// The prelude, and the structs and functions of the lines of models.def that are wanted.
std::string model_source(const std::function<bool(const models::Entry&)>& wanted);

/// The function of a line: "beckmann_slope", "cook_torrance".
std::string function_name(const models::Entry& entry);

/// The struct of its parameters, "BeckmannSlope"; empty for an attenuation, which has none.
std::string struct_name(const models::Entry& entry);

}  // namespace metamer::gl
