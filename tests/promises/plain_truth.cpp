#include "tests/promises/plain_truth.h"

#include <algorithm>

#include "common/transport/fold.h"
#include "server/methods/direct_errors.h"
#include "server/transport/expand.h"
#include "server/transport/factor_rows.h"

namespace metamer::promises {

PlainTruth::PlainTruth(const RenderScene& scene, const Observer& observer)
    : factors_(factor_sources(scene), test::PlainSum::wavelengths()) {
  bool has_white = false;
  for (const RenderLight& light : scene.lights) {
    lights_.emplace_back(scene.emissions[light.emission], observer);
    luminances_.push_back(light.luminance);
    if (has_white || !(light.luminance > 0)) continue;
    white_ = lights_.back().white();
    for (double& value : white_) value *= light.luminance;
    white_ = usable_white(white_);
    has_white = true;
  }
}

/// A chain is a weighted sum of products of nodes.
struct PlainTruth::Fold : FoldHooks {
  struct Part {
    std::vector<FactorNode> nodes;
    double weight;
  };
  PlainTruth& truth;
  std::vector<std::vector<Part>> chains;
  Xyz sum{};

  Fold(PlainTruth& of, std::size_t count) : truth(of), chains(count) { chains[0] = {{{}, 1}}; }

  void enter(std::uint32_t chain, std::uint32_t parent, const Factor& factor) {
    const FactorNodes<double> nodes = expand<double>(factor);
    for (const Part& before : chains[parent])
      for (std::size_t j = 0; j < nodes.count; ++j) {
        chains[chain].push_back({before.nodes, before.weight * nodes.weight[j]});
        chains[chain].back().nodes.push_back(nodes.node[j]);
      }
  }

  void lobes(std::uint32_t chain, std::uint32_t material, std::span<const LobeWeights> weights) {
    lobes_as_terms(*this, chain, material, weights);
  }

  void term(std::uint32_t chain, std::uint32_t light, const FactorNode& factor, float weight) {
    for (const Part& part : chains[chain]) {
      Product product{light, part.nodes};
      product.nodes.push_back(factor);
      std::erase_if(product.nodes, [](const FactorNode& n) { return n.kind == FactorKind::white; });
      std::sort(product.nodes.begin(), product.nodes.end());
      const Xyz& xyz = truth.xyz_of(product);
      for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += weight * part.weight * xyz[axis];
    }
  }
};

const Xyz& PlainTruth::xyz_of(const Product& product) {
  const auto [entry, is_new] = products_.try_emplace(product);
  if (is_new) {
    std::vector<double> values(test::PlainSum::wavelengths().size(), 1.0);
    for (const FactorNode& node : product.nodes) {
      const std::vector<double>& factor = factors_(node);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] *= factor[i];
    }
    entry->second = lights_[product.light](values);
    for (double& value : entry->second) value *= luminances_[product.light];
  }
  return entry->second;
}

Xyz PlainTruth::resolve(const Gather& gather, double scale) {
  Fold carrier(*this, gather.chains().size());
  fold(gather, carrier);
  for (double& value : carrier.sum) value *= scale;
  return carrier.sum;
}

}  // namespace metamer::promises
