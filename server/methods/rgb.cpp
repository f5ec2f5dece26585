#include "server/methods/rgb.h"

#include "common/color/rgb_of_spectra.h"
#include "common/color/srgb.h"
#include "server/methods/banded.h"
#include "server/methods/scene_spectra.h"

namespace metamer {
namespace {

std::vector<double> as_list(const Rgb& rgb) { return {rgb.begin(), rgb.end()}; }

}  // namespace

std::unique_ptr<Method> make_rgb(const v1::Plan&, const RenderScene& scene) {
  const Observer& observer = scene.observer;
  LightTables lights(scene, 3, [&](const Spectrum& emission, double luminance) {
    return as_list(light_rgb(observer, emission, luminance));
  });

  FactorRows rows(scene);
  BandTable values(rows.size(), 3);
  const std::vector<double> nm = surface_edges(scene);
  const SurfaceRgb color(observer, nm);
  rows.for_each(scene, nm, [&](std::uint32_t row, const std::vector<double>& at) {
    values.set(row, as_list(color(at)));
  });

  BandTable xyz(3, 3);
  for (std::size_t i = 0; i < 3; ++i)
    xyz.set(i, {srgb::to_xyz_matrix()[i].begin(), srgb::to_xyz_matrix()[i].end()});
  return std::make_unique<BandedMethod>(
      std::move(rows), BandedMethod::Tables{std::move(lights), std::move(values), std::move(xyz)});
}

}  // namespace metamer
