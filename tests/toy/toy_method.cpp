#include "server/methods/toy.h"

#include <numeric>

#include "common/color/xyz.h"
#include "server/methods/banded.h"

namespace metamer {

std::unique_ptr<Method> make_toy(const v1::Plan&, const RenderScene& scene) {
  const Wavelengths wavelengths = observer_wavelengths();
  const ObserverWeights observer = observer_weights(scene.observer, wavelengths);

  BandTable lights(scene.lights.size(), 3);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const auto power =
        resample(scene.emissions[scene.lights[i].emission], wavelengths.nm(), Outside::zero).values;
    const double scale = luminance_scale(observer, power, scene.lights[i].luminance);
    const Xyz xyz = to_xyz(observer, power);
    lights.set(i, {scale * xyz[0], scale * xyz[1], scale * xyz[2]});
  }

  FactorRows rows(scene);
  BandTable values(rows.size(), 3), xyz(3, 3);
  rows.for_each(scene, wavelengths.nm(), [&](std::uint32_t row, const std::vector<double>& at) {
    std::vector<double> seen;
    for (const std::vector<double>& axis : observer.weights)
      seen.push_back(std::inner_product(axis.begin(), axis.end(), at.begin(), 0.0) /
                     std::accumulate(axis.begin(), axis.end(), 0.0));
    values.set(row, seen);
  });
  for (std::size_t i = 0; i < 3; ++i) {
    std::vector<double> own(3);
    own[i] = 1;
    xyz.set(i, own);
  }
  return std::make_unique<BandedMethod>(
      std::move(rows), BandedMethod::Tables{std::move(lights), std::move(values), std::move(xyz)});
}

}  // namespace metamer
