#include "server/plan/spectral_fold.h"

#include "common/transport/fold.h"
#include "server/transport/expand.h"
#include "server/transport/factor_rows.h"

namespace metamer {

SpectralFold::SpectralFold(const RenderScene& scene, std::vector<Values> lights, const Values& nm)
    : bands_(nm.size()),
      scene_(scene),
      lights_(std::move(lights)),
      factors_(factor_sources(scene), nm) {
  for (const RenderScene::Reradiated& one : scene.reradiated)
    reradiated_.push_back(resample(one.power, nm, Outside::zero).values);
}

/// Reflects each light at the end of a chain, and carries it back to the eye.
struct SpectralFold::Walk : FoldHooks {
  SpectralFold& of;

  double* carrier(std::uint32_t chain) const { return of.carriers_.data() + chain * of.bands_; }

  void lobes(std::uint32_t chain, std::uint32_t material, std::span<const LobeWeights> weights) {
    lobes_as_terms(*this, chain, material, weights);
  }

  void term(std::uint32_t chain, std::uint32_t light, const FactorNode& factor, float weight) {
    if (factor.kind == FactorKind::reradiate) return reradiate(chain, light, factor.index, weight);
    const Values &power = of.lights_[light], &values = of.factors_(factor);
    double* to = carrier(chain);
    for (std::size_t i = 0; i < values.size(); ++i) to[i] += double{weight} * power[i] * values[i];
  }

  void reradiate(std::uint32_t chain, std::uint32_t light, std::uint32_t material, float weight) {
    const Values& power = of.reradiated_[of.scene_.reradiated_index(
        light, *of.scene_.materials[material].fluorescence)];
    const double scale = double{weight} * of.scene_.lights[light].luminance;
    double* to = carrier(chain);
    for (std::size_t i = 0; i < power.size(); ++i) to[i] += scale * power[i];
  }

  /// An exact Fresnel term lies on the line between two nodes, within 2e-5 (fresnel_table.h).
  void leave(std::uint32_t chain, std::uint32_t parent, const Factor& factor) {
    const FactorNodes<double> nodes = expand<double>(factor);
    const double* from = carrier(chain);
    double* to = carrier(parent);
    for (std::size_t j = 0; j < nodes.count; ++j) {
      const Values& values = of.factors_(nodes.node[j]);
      for (std::size_t i = 0; i < values.size(); ++i)
        to[i] += nodes.weight[j] * from[i] * values[i];
    }
  }
};

std::span<const double> SpectralFold::operator()(const Gather& gather) {
  carriers_.assign(gather.chains().size() * bands_, 0.0);
  fold(gather, Walk{{}, *this});
  return std::span(carriers_).first(bands_);
}

}  // namespace metamer
