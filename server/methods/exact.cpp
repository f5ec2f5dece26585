#include "server/methods/exact.h"

#include <cmath>
#include <set>

#include "server/methods/exact_tables.h"

namespace metamer {
namespace {

/// Signatures over mirrors are looked up where there can be no more than this: what they take then
/// is milliseconds and megabytes.
constexpr double most_looked_up = 1 << 16;

/// The rows of the mirrors that some object has.
std::size_t mirror_rows(const RenderScene& scene) {
  std::set<std::uint32_t> spectra;
  std::size_t nodes = 0;
  for (const RenderMaterial& material : scene.materials) {
    if (!(material.mirror > 0)) continue;
    if (material.fresnel == FresnelKind::exact)
      nodes += fresnel_nodes;
    else
      spectra.insert(material.specular);
  }
  return spectra.size() + nodes;
}

}  // namespace

std::uint64_t direct_signatures(const RenderScene& scene) {
  return std::uint64_t{FactorRows(scene).size()} * scene.lights.size();
}

void plan_exact(const RenderScene& scene, const v1::Settings&, v1::Plan& plan) {
  plan.set_signatures(direct_signatures(scene));
}

bool carries_bands(const RenderScene& scene, std::uint32_t depth) {
  const auto mirrors = static_cast<double>(mirror_rows(scene));
  double products = 0;
  for (std::uint32_t k = 1; k <= depth; ++k) products += std::pow(mirrors, k);
  return products * static_cast<double>(direct_signatures(scene)) > most_looked_up;
}

std::unique_ptr<Method> make_exact(const v1::Plan& plan, const RenderScene& scene) {
  const Observer& observer = scene.observer;
  ExactTables tables(scene, observer);
  if (carries_bands(scene, plan.depth()))
    return make_exact_bands(std::move(tables), scene, observer);
  return make_exact_signatures(std::move(tables));
}

}  // namespace metamer
