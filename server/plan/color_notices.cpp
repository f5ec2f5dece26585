#include "server/plan/color_notices.h"

#include <set>

#include <algorithm>

#include "common/color/ends_of_data.h"
#include "common/scene/methods.h"
#include "server/methods/direct_errors.h"

namespace metamer {
namespace {

std::string formatted(const char* format, auto... values) {
  char text[320];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

void add(const std::string& field, const std::string& message, v1::Plan& plan) {
  v1::Notice* notice = plan.add_notice();
  notice->set_field(field);
  notice->set_message(message);
}

}  // namespace

void notice_colors(const RenderScene& scene, const Method& method, v1::Plan& plan) {
  const std::string name = method_text(plan.method());
  for (const LightError& error : DirectColors(scene, scene.observer).errors(method)) {
    const RenderLight& light = scene.lights[error.light];
    const std::string& field = scene.emission_fields[light.emission];
    const std::string named = "light \"" + light.name + "\"";
    if (!error.seen || error.dark) {
      add(field,
          named + " stays dark: the observer sees nothing of it" +
              (error.seen ? " at these wavelengths" : ""),
          plan);
      continue;
    }
    if (!(std::max(error.white, error.material) > unnoticed_difference)) continue;
    std::string text = "by " + name + ", ";
    if (error.white > unnoticed_difference)
      text += formatted("the white of %s is ΔE00 %.2g off", named.c_str(), error.white);
    if (error.material > unnoticed_difference)
      text += formatted(error.white > unnoticed_difference ? ", \"%s\" under it %.2g"
                                                           : "\"%s\" is ΔE00 %.2g off under %s",
                        scene.materials[error.worst].name.c_str(), error.material, named.c_str());
    add(field, text + "; method exact is not", plan);
  }
}

void notice_ends_of_data(const RenderScene& scene, v1::Plan& plan) {
  const auto tell = [&](const std::string& field, const std::string& message) {
    if (!message.empty()) add(field, message, plan);
  };
  const Observer& observer = scene.observer;
  tell("settings.observer_file", ends_of_observer(observer));
  std::set<std::uint32_t> parts;  // the whole has been told of
  for (const RenderLight& light : scene.lights)
    if (light.emission != light.own_emission) parts.insert(light.emission);
  for (std::uint32_t i = 0; i < scene.emissions.size(); ++i)
    if (!parts.contains(i))
      tell(scene.emission_fields[i], ends_of_light(scene.emissions[i], observer));
  std::vector<CumulativeLight> lights;
  for (const RenderLight& light : scene.lights)
    lights.emplace_back(light.name, scene.emissions[light.emission], observer);
  for (std::size_t i = 0; i < scene.properties.size(); ++i)
    tell(scene.property_fields[i], ends_of_property(scene.properties[i], lights));
  for (std::size_t i = 0; i < scene.constants.size(); ++i)
    tell(scene.constants_fields[i], ends_of_property(scene.constants[i].n, lights));
}

}  // namespace metamer
