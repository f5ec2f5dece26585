#include "server/methods/direct_errors.h"

#include <algorithm>
#include <set>

#include "common/color/lab.h"
#include "common/color/xyz.h"
#include "common/transport/factor_values.h"
#include "server/methods/scene_spectra.h"
#include "server/transport/factor_rows.h"

namespace metamer {
namespace {

constexpr std::size_t most_pairs = 16384;

/// The spectra that a material may show by itself.
std::vector<FactorNode> factors_of(const RenderMaterial& material, std::uint32_t index) {
  std::vector<FactorNode> factors{{FactorKind::diffuse, index, 0}};
  if (material.fresnel == FresnelKind::exact)
    factors.push_back({FactorKind::fresnel, index, fresnel_nodes - 1});
  else if (material.has(models::highlighted) || material.mirror > 0)
    factors.push_back({FactorKind::specular, index, 0});
  return factors;
}

std::vector<std::uint32_t> used_materials(const RenderScene& scene) {
  const std::set<std::uint32_t> used = seen_materials(scene);
  const std::vector<std::uint32_t> all(used.begin(), used.end());
  const std::size_t room = most_pairs / std::max<std::size_t>(1, 2 * scene.lights.size());
  if (all.size() <= room) return all;
  std::vector<std::uint32_t> some;
  for (std::size_t i = 0; i < room; ++i) some.push_back(all[i * all.size() / room]);
  return some;
}

double difference(const Xyz& one, const Xyz& other, const Xyz& white) {
  return delta_e_00(to_lab(one, white), to_lab(other, white));
}

}  // namespace

DirectColors::DirectColors(const RenderScene& scene, const Observer& observer) : scene_(scene) {
  const std::vector<double> nm = surface_edges(scene), ones(nm.size(), 1.0);
  const std::vector<std::uint32_t> materials = used_materials(scene);
  FactorValues<double> values(factor_sources(scene), nm);
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
    const ObserverWeights lit =
        under_light(observer, scene.emissions[scene.lights[i].emission], nm);
    whites_.push_back(to_xyz(lit, ones));
    if (!(whites_.back()[1] > 0)) continue;
    for (const std::uint32_t material : materials)
      for (const FactorNode& factor : factors_of(scene.materials[material], material)) {
        pairs_.push_back({i, material, factor, to_xyz(lit, values(factor))});
        if (factor.kind != FactorKind::diffuse || !scene.materials[material].fluorescence) continue;
        const Xyz more = emission_xyz(scene.reradiated_by(i, material).power, observer);
        for (std::size_t axis = 0; axis < 3; ++axis) pairs_.back().xyz[axis] += more[axis];
      }
  }
}

std::vector<LightError> DirectColors::errors(const Method& method) const {
  const auto scratch = method.make_scratch();
  Gather gather(scene_.lights.size());
  const auto seen = [&](std::uint32_t light, const FactorNode& factor) {
    gather.clear();
    const auto weight = static_cast<float>(1 / scene_.lights[light].luminance);
    gather.add(0, light, factor, weight);
    if (factor.kind == FactorKind::diffuse && scene_.materials[factor.index].fluorescence)
      gather.add(0, light, {FactorKind::reradiate, factor.index, 0}, weight);
    const std::array<float, 3> xyz = method.resolve(gather, 1, *scratch);
    return Xyz{xyz[0], xyz[1], xyz[2]};
  };
  std::vector<LightError> errors;
  auto pair = pairs_.begin();
  for (std::uint32_t i = 0; i < scene_.lights.size(); ++i) {
    const auto end = std::find_if(pair, pairs_.end(), [&](const Pair& p) { return p.light > i; });
    if (scene_.lights[i].luminance > 0) {
      const Xyz own = seen(i, {FactorKind::white, 0, 0}), white = usable_white(whites_[i]);
      LightError error{.light = i,
                       .seen = whites_[i][1] > 0,
                       .dark = own == Xyz{},
                       .white = difference(own, whites_[i], white),
                       .material = 0};
      for (auto p = pair; p != end; ++p) {
        const double de00 = difference(seen(i, p->factor), p->xyz, white);
        if (!(de00 > error.material)) continue;
        error.material = de00;
        error.worst = p->material;
      }
      errors.push_back(error);
    }
    pair = end;
  }
  return errors;
}

}  // namespace metamer
