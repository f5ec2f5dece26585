#include "server/plan/reference.h"

#include <Eigen/Core>

#include "common/scene/rough_lobe_table.h"
#include "server/methods/direct_errors.h"

namespace metamer {

Wavelengths Reference::cells(const RenderScene& scene, const Observer& observer) {
  std::vector<const Spectrum*> spectra = with_observer(observer, {});
  for (const Spectrum& emission : scene.emissions) spectra.push_back(&emission);
  for (const RenderScene::Reradiated& one : scene.reradiated) spectra.push_back(&one.power);
  for (const Spectrum& property : scene.properties) spectra.push_back(&property);
  for (const OpticalConstants& constants : scene.constants) {
    spectra.push_back(&constants.n);
    spectra.push_back(&constants.k);
  }
  for (const Spectrum& window : scene.windows) spectra.push_back(&window);
  for (const RenderMaterial& material : scene.materials)
    if (material.has(models::diffracting)) spectra.push_back(&lobe_grid());
  return cells_of(spectra);
}

Reference::Reference(const RenderScene& scene, const Observer& observer)
    : Reference(scene, observer, cells(scene, observer)) {}

Reference::Reference(const RenderScene& scene, const Observer& observer,
                     const Wavelengths& wavelengths)
    : observer_(observer_weights(observer, wavelengths)),
      fold_(scene, light_powers(scene, wavelengths.nm()), wavelengths.nm()) {}

/// Of a perfect white that faces the light; where that is one of several that an environment's
/// picture became, under all of them together where they are alike.
Xyz Reference::white_under(const RenderScene& scene, const RenderLight& light,
                           const std::vector<double>& nm) const {
  double luminance = 0;
  for (const RenderLight& one : scene.lights)
    if (&one == &light || (one.field == light.field && !one.field.empty()))
      luminance += one.luminance;
  Values power = resample(scene.emissions[light.own_emission], nm, Outside::zero).values;
  const double scale = luminance_scale(observer_, power, luminance);
  for (double& value : power) value *= scale;
  return usable_white(to_xyz(observer_, power));
}

/// With their luminance, E[3.2-4]; on the way the white, of the first that the observer sees.
std::vector<Reference::Values> Reference::light_powers(const RenderScene& scene,
                                                       const std::vector<double>& nm) {
  std::vector<Values> powers;
  bool has_white = false;
  for (const RenderLight& light : scene.lights) {
    Values power = resample(scene.emissions[light.emission], nm, Outside::zero).values;
    const double scale = luminance_scale(observer_, power, light.luminance);
    for (double& value : power) value *= scale;
    if (!has_white && scale > 0) {
      white_ = white_under(scene, light, nm);
      has_white = true;
    }
    scales_.push_back(scale);
    powers.push_back(std::move(power));
  }
  return powers;
}

Xyz Reference::resolve(const Gather& gather, double scale) {
  Xyz xyz{};
  if (gather.is_dark()) return xyz;
  const std::span<const double> eye = fold_(gather);
  using Row = Eigen::Map<const Eigen::VectorXd>;  // whose sums are made in lanes
  const auto size = static_cast<Eigen::Index>(eye.size());
  for (std::size_t axis = 0; axis < 3; ++axis)
    xyz[axis] = scale * Row(eye.data(), size).dot(Row(observer_.weights[axis].data(), size));
  return xyz;
}

}  // namespace metamer
