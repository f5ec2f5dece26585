#include "server/methods/point.h"

#include "common/color/xyz.h"
#include "common/scene/settings.h"
#include "server/methods/banded.h"
#include "server/methods/fitted.h"

namespace metamer {

Wavelengths wavelengths_of_point(const v1::Method& method) {
  return method.point().has_fitted() ? observer_wavelengths() : *point_wavelengths(method.point());
}

void plan_point(const RenderScene& scene, const v1::Settings& settings, v1::Plan& plan) {
  if (settings.method().point().has_fitted()) return plan_fitted(scene, settings, plan);
  plan.set_bands(static_cast<std::uint32_t>(wavelengths_of_point(settings.method()).size()));
}

std::unique_ptr<Method> make_point(const v1::Plan& plan, const RenderScene& scene) {
  if (plan.method().point().has_fitted()) return make_fitted(plan, scene);
  const Wavelengths wavelengths = wavelengths_of_point(plan.method());
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
