#include "server/methods/light_tables.h"

namespace metamer {

LightTables::LightTables(
    const RenderScene& scene, std::size_t bands,
    const std::function<std::vector<double>(const Spectrum&, double luminance)>& power)
    : lights(scene.lights.size(), bands),
      fluorescences(scene.fluorescences.size()),
      emitted(scene.reradiated.size(), bands) {
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const RenderLight& light = scene.lights[i];
    lights.set(i, power(scene.emissions[light.emission], light.luminance));
    from.push_back({light.emission, static_cast<float>(light.luminance)});
  }
  for (std::size_t i = 0; i < scene.reradiated.size(); ++i)
    emitted.set(i, power(scene.reradiated[i].power, scene.reradiated[i].luminance));
}

}  // namespace metamer
