#include "server/methods/point.h"

#include "common/color/xyz.h"
#include "common/scene/settings.h"
#include "server/methods/banded.h"

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

  FactorRows rows(scene);
  BandTable values(rows.size(), bands);
  rows.for_each(scene, wavelengths.nm(),
                [&](std::uint32_t row, const std::vector<double>& at) { values.set(row, at); });

  BandTable xyz(3, bands);
  for (std::size_t i = 0; i < 3; ++i) xyz.set(i, observer.weights[i]);
  return std::make_unique<BandedMethod>(
      std::move(rows), BandedMethod::Tables{std::move(lights), std::move(values), std::move(xyz)});
}

}  // namespace metamer
