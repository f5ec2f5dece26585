#include "server/render/pilot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "common/color/error_statistics.h"
#include "server/methods/scene_spectra.h"
#include "server/transport/factor_rows.h"
#include "server/transport/mirror.h"

namespace metamer {
namespace {

constexpr std::size_t max_scene_colors = 2048;

/// A pixel that receives one light from one surface, over a mirror, through a clear material, or
/// neither.
class ColorPatch {
 public:
  ColorPatch(const RenderScene& scene, std::uint32_t light)
      : light_(light), gather_(gather_for(scene)) {}

  ColorPatch over(const Factor& factor, std::uint32_t times) const {
    ColorPatch other = *this;
    for (std::uint32_t i = 0; i < times; ++i)
      other.chain_ = other.gather_.chain(other.chain_, factor);
    return other;
  }
  Gather diffuse(std::uint32_t material) const {
    return with(material, {.diffuse = 1, .specular = 0, .white = 0});
  }
  /// A highlight as bright as a white that faces the light.
  Gather specular(const RenderScene& scene, std::uint32_t material) const {
    if (scene.materials[material].fresnel != FresnelKind::exact)
      return with(material, {.diffuse = 0, .specular = 1, .white = 0});
    Gather gather = gather_;
    gather.add(chain_, light_, {FactorKind::fresnel, material, fresnel_nodes - 1}, 1);
    return gather;
  }

 private:
  Gather with(std::uint32_t material, const LobeWeights& weights) const {
    Gather gather = gather_;
    gather.weights(gather.surface(chain_, material), light_) = weights;
    return gather;
  }

  std::uint32_t light_, chain_ = 0;
  Gather gather_;
};

}  // namespace

std::uint32_t pilot_count(const v1::Plan& plan) {
  const std::uint64_t pixels = std::uint64_t{plan.width()} * plan.height();
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(pixels / 1024, 16, 256));
}

PilotPixels trace_pixels(const Probe& probe, const v1::Plan& plan, PixelRun run,
                         Reference& reference, const std::atomic<bool>& stopped,
                         std::atomic<std::uint64_t>& work) {
  TracedPixels traced = probe.trace(plan, run, stopped, work);
  PilotPixels pixels;
  pixels.scale = 1 / static_cast<float>(plan.spp());
  pixels.gathers = std::move(traced.gathers);
  pixels.trace_seconds = traced.seconds;
  pixels.rays = traced.rays;
  for (const Gather& gather : pixels.gathers) {
    pixels.reference.push_back(
        to_lab(reference.resolve(gather, 1.0 / plan.spp()), reference.white()));
    if (++work; stopped) break;
  }
  pixels.gathers.erase(
      pixels.gathers.begin() + static_cast<std::ptrdiff_t>(pixels.reference.size()),
      pixels.gathers.end());
  return pixels;
}

PilotPixels scene_colors(const RenderScene& scene, Reference& reference) {
  const std::set<std::uint32_t> used = seen_materials(scene);
  std::vector<std::pair<Factor, std::uint32_t>> passed;  // so many times
  for (const std::uint32_t index : used) {
    const RenderMaterial& material = scene.materials[index];
    for (std::uint32_t n = 1; n <= std::min(scene.bounces, most_bounces); n *= 2)
      passed.push_back({{FactorKind::diffuse, index, 0}, n});
    if (material.mirror > 0) passed.push_back({mirror_factor(material, index, 1), 1});
    if (absorbs(scene, material))  // through its thickness
      passed.push_back({{FactorKind::absorb, index,
                         static_cast<float>(scene.media[material.medium].optical_depth)},
                        1});
  }
  PilotPixels pixels;
  const auto add = [&](const Gather& gather) {
    if (pixels.gathers.size() >= max_scene_colors) return;
    pixels.gathers.push_back(gather);
    pixels.reference.push_back(to_lab(reference.resolve(gather, 1), reference.white()));
  };
  const auto add_all = [&](const ColorPatch& patch) {
    for (const std::uint32_t material : used) {
      add(patch.diffuse(material));
      if (scene.materials[material].has(models::highlighted)) add(patch.specular(scene, material));
    }
  };
  for (std::uint32_t light = 0; light < scene.lights.size(); ++light) add_all({scene, light});
  for (std::uint32_t light = 0; light < scene.lights.size(); ++light)
    for (const auto& [factor, times] : passed)
      add_all(ColorPatch(scene, light).over(factor, times));
  return pixels;
}

std::vector<double> color_errors(const Method& method, const PilotPixels& pixels, PixelRange range,
                                 const Xyz& white, Method::Scratch& scratch) {
  std::vector<double> errors;
  errors.reserve(range.last - range.first);
  for (std::size_t i = range.first; i < range.last; ++i) {
    const std::array<float, 3> xyz = method.resolve(pixels.gathers[i], pixels.scale, scratch);
    errors.push_back(delta_e_00(to_lab({xyz[0], xyz[1], xyz[2]}, white), pixels.reference[i]));
  }
  return errors;
}

double bounded_share(std::uint32_t count) { return std::pow(0.05, 1.0 / count); }

v1::ColorError summarize(const std::vector<double>& errors) {
  const ErrorStatistics statistics = error_statistics(errors);
  v1::ColorError error;
  error.set_pixels(static_cast<std::uint32_t>(errors.size()));
  error.set_mean(statistics.mean);
  error.set_percentile_95(statistics.percentile_95);
  error.set_maximum(statistics.not_finite == 0 ? statistics.maximum
                                               : std::numeric_limits<double>::infinity());
  return error;
}

}  // namespace metamer
