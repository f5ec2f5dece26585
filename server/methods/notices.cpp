#include "server/methods/notices.h"

#include "common/color/xyz.h"
#include "common/scene/settings.h"

namespace metamer {

void plan_found(std::size_t found, std::size_t asked, const char* field, const std::string& verb,
                const std::string& noun, v1::Plan& plan) {
  plan.set_bands(static_cast<std::uint32_t>(found));
  if (found == asked) return;
  v1::Notice* notice = plan.add_notice();
  notice->set_field(field);
  notice->set_message("the scene's spectra " + verb + " no more than " + std::to_string(found) +
                      " " + noun + (found == 1 ? "" : "s"));
}

void notice_dark_lights(const RenderScene& scene, const v1::Settings& settings,
                        const Wavelengths& wavelengths, v1::Plan& plan) {
  const ObserverWeights observer = observer_weights(to_observer(settings.observer()), wavelengths);
  for (const RenderLight& light : scene.lights) {
    const Spectrum& emission = scene.emissions[light.emission];
    const auto power = resample(emission, wavelengths.nm(), Outside::zero).values;
    if (luminance_scale(observer, power, light.luminance) > 0 || light.luminance == 0) continue;
    v1::Notice* notice = plan.add_notice();
    notice->set_field(scene.emission_fields[light.emission]);
    notice->set_message("light \"" + light.name +
                        "\" stays dark: the observer sees nothing of it at these wavelengths");
  }
}

}  // namespace metamer
