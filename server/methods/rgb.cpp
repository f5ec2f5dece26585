#include "server/methods/rgb.h"

#include "common/color/srgb.h"
#include "common/color/xyz.h"
#include "common/scene/settings.h"
#include "server/methods/banded.h"

namespace metamer {
namespace {

/// Linear sRGB of a light of luminance `luminance`, seen directly.
std::vector<double> light_rgb(const ObserverWeights& observer, const Spectrum& emission,
                              const std::vector<double>& nm, double luminance) {
  const auto power = resample(emission, nm, Outside::zero).values;
  const double scale = luminance_scale(observer, power, luminance);
  const Xyz xyz = to_xyz(observer, power);
  const srgb::Rgb rgb = srgb::from_xyz({scale * xyz[0], scale * xyz[1], scale * xyz[2]});
  return {rgb.begin(), rgb.end()};
}

/// Linear sRGB, under D65 of luminance 1, of a surface that reflects so much at each of `nm`.
std::vector<double> surface_rgb(const ObserverWeights& observer, std::vector<double> reflected,
                                const std::vector<double>& nm) {
  const auto d65 = resample(*cie::illuminant("D65"), nm, Outside::zero).values;
  for (std::size_t i = 0; i < nm.size(); ++i) reflected[i] *= d65[i];
  const double scale = luminance_scale(observer, d65, 1);
  const Xyz xyz = to_xyz(observer, reflected);
  const srgb::Rgb rgb = srgb::from_xyz({scale * xyz[0], scale * xyz[1], scale * xyz[2]});
  return {rgb.begin(), rgb.end()};
}

}  // namespace

Wavelengths rgb_wavelengths() { return *Wavelengths::uniform(360, 830, 1); }

std::unique_ptr<Method> make_rgb(const v1::Plan& plan, const RenderScene& scene) {
  const Wavelengths wavelengths = rgb_wavelengths();
  const ObserverWeights observer = observer_weights(to_observer(plan.observer()), wavelengths);

  BandTable lights(scene.lights.size(), 3);
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    lights.set(i, light_rgb(observer, scene.emissions[scene.lights[i].emission], wavelengths.nm(),
                            scene.lights[i].luminance));

  SceneRows rows(scene);
  BandTable values(rows.size(), 3);
  rows.for_each(scene, wavelengths.nm(), [&](std::uint32_t row, std::vector<double> at) {
    // White is what it is: the tables' D65 and that of sRGB differ in the fourth digit.
    values.set(row, row == SceneRows::white
                        ? std::vector<double>{1, 1, 1}
                        : surface_rgb(observer, std::move(at), wavelengths.nm()));
  });

  BandTable xyz(3, 3);
  for (std::size_t i = 0; i < 3; ++i)
    xyz.set(i, {srgb::to_xyz_matrix()[i].begin(), srgb::to_xyz_matrix()[i].end()});
  return std::make_unique<BandedMethod>(
      std::move(rows), BandedMethod::Tables{std::move(lights), std::move(values), std::move(xyz)});
}

}  // namespace metamer
