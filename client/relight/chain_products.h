#pragma once

#include <utility>
#include <vector>

#include "client/relight/scene_sources.h"
#include "common/transport/factor_values.h"
#include "common/transport/fold.h"

namespace metamer::client {

/// Makes the product of each chain, and gives those of each term to `take`: chain's product, light,
/// factor's node.
template <class Take>
struct ChainProducts : FoldHooks {
  ChainProducts(const v1::SceneFactors& scene, const std::vector<double>& nm, Take take)
      : sources(scene),
        factors(sources.factors(), nm),
        chains{std::vector<float>(nm.size(), 1.0f)},
        take(take) {}

  void enter(std::uint32_t, std::uint32_t parent, const FactorNode& factor) {
    std::vector<float> row = chains[parent];
    const std::vector<float>& values = factors(factor);
    for (std::size_t k = 0; k < row.size(); ++k) row[k] *= values[k];
    chains.push_back(std::move(row));
  }

  void term(std::uint32_t chain, std::uint32_t light, const FactorNode& factor, float) {
    take(chains[chain], light, factor);
  }

  SceneSources sources;
  FactorValues<float> factors;
  std::vector<std::vector<float>> chains;
  Take take;
};

}  // namespace metamer::client
