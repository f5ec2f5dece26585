#include "server/gl/lights.h"

#include <bit>
#include <set>

#include "server/gl/model_source.h"

namespace metamer::gl {
namespace {

/// Where a light's words are.
constexpr std::size_t which_at = 0, solid_angle_at = 1, values_at = 2,
                      light_size = values_at + lights::max_values;

std::string literal(std::size_t value) { return std::to_string(value) + "u"; }

std::string light_struct(const lights::Entry& entry) { return std::string(entry.type) + "Light"; }

/// "struct PointLight { Real reference_squared; Vec3 position; };": as
/// common/lights/all_lights.cmake has it.
std::string light_struct_text(const lights::Entry& entry) {
  std::string text = "struct " + light_struct(entry) + " { Real reference_squared;";
  for (const lights::Parameter& parameter : entry.parameters) {
    text += lights::value_count(parameter.kind) == 3 ? " Vec3 " : " Real ";
    text += parameter.name;
    text += parameter.kind == lights::Parameter::Kind::angle ? "_versine;" : ";";
  }
  return text + " };\n";
}

std::string real_at(std::size_t place) {
  return "light_real(base + " + literal(values_at + place) + ")";
}

/// "PointLight(light_real(base + 2u), vec3(light_real(base + 3u), …))"
std::string light_arguments(const lights::Entry& entry) {
  std::string text = light_struct(entry) + "(" + real_at(0);
  std::size_t at = 1;
  for (const lights::Parameter& parameter : entry.parameters) {
    if (lights::value_count(parameter.kind) == 3)
      text += ", vec3(" + real_at(at) + ", " + real_at(at + 1) + ", " + real_at(at + 2) + ")";
    else
      text += ", " + real_at(at);
    at += lights::value_count(parameter.kind);
  }
  return text + ")";
}

}  // namespace

std::vector<std::uint32_t> light_words(const RenderScene& scene) {
  std::vector<std::uint32_t> words;
  for (const RenderLight& light : scene.lights) {
    words.push_back(static_cast<std::uint32_t>(light.light));
    words.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(light.solid_angle)));
    for (const double value : light.values())
      words.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(value)));
  }
  return words;
}

std::string light_source(const RenderScene& scene) {
  std::set<unsigned char> used;
  for (const RenderLight& light : scene.lights)
    used.insert(static_cast<unsigned char>(light.light));
  std::string text(shader_text("lights/incident.glsl"));
  for (const lights::Entry& entry : lights::registry()) {
    if (!used.contains(entry.index)) continue;
    text += light_struct_text(entry);
    text += shader_text("lights/" + std::string(entry.name) + ".glsl");
  }

  // What reads them.
  text +=
      "layout(std430, binding = 15) readonly buffer Lights { uint light_word_of[]; };\n"
      "float light_real(uint at) { return uintBitsToFloat(light_word_of[at]); }\n"
      "float solid_angle_of(uint light) { return light_real(light * " +
      literal(light_size) + " + " + literal(solid_angle_at) +
      "); }\n"
      "Incident incident(uint light, vec3 at) {\n    uint base = light * " +
      literal(light_size) + ";\n    switch (light_word_of[base + " + literal(which_at) + "]) {\n";
  for (const lights::Entry& entry : lights::registry())
    if (used.contains(entry.index))
      text += "        case " + literal(entry.index) + ": return " + entry.name + "_light(at, " +
              light_arguments(entry) + ");\n";
  return text + "    }\n    return Incident(vec3(0.0), 0.0, 0.0);\n}\n";
}

}  // namespace metamer::gl
