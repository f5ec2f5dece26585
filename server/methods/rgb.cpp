#include "server/methods/rgb.h"

#include <numeric>

#include "common/color/srgb.h"
#include "common/color/xyz.h"
#include "server/methods/banded.h"
#include "server/methods/scene_spectra.h"

namespace metamer {
namespace {

/// Linear sRGB of a light of luminance `luminance`, seen directly.
std::vector<double> light_rgb(const Observer& observer, const Spectrum& emission,
                              double luminance) {
  Xyz xyz = white_of(emission, observer);
  for (double& value : xyz) value *= luminance;
  const srgb::Rgb rgb = srgb::from_xyz(xyz);
  return {rgb.begin(), rgb.end()};
}

/// What turns a reflectance into linear sRGB under D65: a list of weights for each of R, G and B.
/// Those of each sum to 1, so that grey is grey: the tables' D65 and that of sRGB differ in the
/// fourth digit.
std::array<std::vector<double>, 3> surface_weights(const Observer& observer,
                                                   const std::vector<double>& nm) {
  const ObserverWeights lit = under_light(observer, *cie::illuminant("D65"), nm);
  std::array<std::vector<double>, 3> weights;
  for (std::vector<double>& own : weights) own.resize(nm.size());
  for (std::size_t i = 0; i < nm.size(); ++i) {
    const auto& [x, y, z] = lit.weights;
    const srgb::Rgb rgb = srgb::from_xyz({x[i], y[i], z[i]});
    for (std::size_t channel = 0; channel < 3; ++channel) weights[channel][i] = rgb[channel];
  }
  for (std::vector<double>& own : weights) {
    const double sum = std::accumulate(own.begin(), own.end(), 0.0);
    for (double& value : own) value /= sum;
  }
  return weights;
}

}  // namespace

std::unique_ptr<Method> make_rgb(const v1::Plan&, const RenderScene& scene) {
  const Observer& observer = scene.observer;
  BandTable lights(scene.lights.size(), 3);
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    lights.set(i, light_rgb(observer, scene.emissions[scene.lights[i].emission],
                            scene.lights[i].luminance));

  FactorRows rows(scene);
  BandTable values(rows.size(), 3);
  const std::vector<double> nm = surface_edges(scene);
  const auto weights = surface_weights(observer, nm);
  rows.for_each(scene, nm, [&](std::uint32_t row, const std::vector<double>& at) {
    std::vector<double> color;
    for (const std::vector<double>& own : weights)
      color.push_back(std::inner_product(own.begin(), own.end(), at.begin(), 0.0));
    values.set(row, color);
  });

  BandTable xyz(3, 3);
  for (std::size_t i = 0; i < 3; ++i)
    xyz.set(i, {srgb::to_xyz_matrix()[i].begin(), srgb::to_xyz_matrix()[i].end()});
  return std::make_unique<BandedMethod>(
      std::move(rows), BandedMethod::Tables{std::move(lights), std::move(values), std::move(xyz)});
}

}  // namespace metamer
