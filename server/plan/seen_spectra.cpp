#include "server/plan/seen_spectra.h"

#include "server/plan/reference.h"

namespace metamer {
namespace {

/// At these wavelengths, as Reference scales them.
std::vector<SpectralFold::Values> scaled_lights(const RenderScene& scene,
                                                const std::vector<double>& nm) {
  const Reference reference(scene, scene.observer);
  std::vector<SpectralFold::Values> lights;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    lights.push_back(resample(scene.emissions[scene.lights[i].emission], nm, Outside::zero).values);
    for (double& value : lights.back()) value *= reference.scales()[i];
  }
  return lights;
}

}  // namespace

SeenSpectra::SeenSpectra(const RenderScene& scene)
    : fold_(scene, scaled_lights(scene, observer_wavelengths().nm()), observer_wavelengths().nm()) {
}

SeenSpectra::Values SeenSpectra::eye(const Gather& gather) {
  const std::span<const double> eye = fold_(gather);
  return {eye.begin(), eye.end()};
}

SeenSpectra::Values SeenSpectra::light(const Values& weights) const {
  Values sum(observer_wavelengths().size());
  for (std::size_t l = 0; l < weights.size(); ++l)
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weights[l] * fold_.lights()[l][i];
  return sum;
}

SeenSpectra::Values SeenSpectra::surface(std::uint32_t material) {
  return fold_.factor({FactorKind::diffuse, material, 0});
}

}  // namespace metamer
