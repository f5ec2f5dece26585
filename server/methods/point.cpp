#include "server/methods/point.h"

#include "common/color/xyz.h"
#include "common/scene/settings.h"
#include "server/methods/banded.h"
#include "server/methods/fresnel_table.h"

namespace metamer {

std::unique_ptr<Method> make_point(const v1::Plan& plan, const RenderScene& scene) {
  const Wavelengths wavelengths = method_wavelengths(plan.method());
  const ObserverWeights observer = observer_weights(to_observer(plan.observer()), wavelengths);
  const std::size_t bands = wavelengths.size();

  // Give each light its luminance with these very samples, E[3.2-4].
  BandTable lights(scene.lights.size(), bands);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    auto power =
        resample(scene.emissions[scene.lights[i].emission], wavelengths.nm(), Outside::zero).values;
    const double scale = luminance_scale(observer, power, scene.lights[i].luminance);
    for (double& value : power) value *= scale;
    lights.set(i, power);
  }

  BandTable properties(scene.properties.size(), bands);
  for (std::size_t i = 0; i < scene.properties.size(); ++i)
    properties.set(i, resample(scene.properties[i], wavelengths.nm(), Outside::hold).values);

  BandTable fresnel(scene.constants.size() * fresnel_nodes, bands);
  for (std::size_t i = 0; i < scene.constants.size(); ++i) {
    const ConstantsAt constants = resample(scene.constants[i], wavelengths.nm());
    for (std::uint32_t node = 0; node < fresnel_nodes; ++node)
      fresnel.set(i * fresnel_nodes + node, fresnel_at(constants, fresnel_node(node)));
  }

  BandTable xyz(3, bands);
  for (std::size_t i = 0; i < 3; ++i) xyz.set(i, observer.weights[i]);
  return std::make_unique<BandedMethod>(
      BandedMethod::Tables{std::move(lights), std::move(properties), std::move(fresnel),
                           std::move(xyz)},
      scene.materials);
}

}  // namespace metamer
