#pragma once

#include "common/scene/fresnel_table.h"
#include "common/transport/factor_sources.h"
#include "common/transport/factor_table.h"

namespace metamer::factors {

/// A material's exact Fresnel term F(u; λ); its table is over the cosine u (fresnel_table.h).
struct Fresnel {
  struct Table {
    static constexpr std::uint32_t nodes = fresnel_nodes;
    static FactorTable make(const OpticalConstants& constants, const std::vector<double>& nm) {
      return [at = resample(constants, nm)](std::uint32_t node) {
        return fresnel_at(at, fresnel_node(node));
      };
    }
  };
  static std::size_t count(const FactorSources& sources) { return sources.materials.size(); }
  static const OpticalConstants* source(const FactorSources& sources, std::uint32_t material) {
    return sources.materials[material].constants;
  }
  /// Between which nodes a cosine lies.
  static FresnelPlace place(float cosine) { return fresnel_place(cosine); }
};

}  // namespace metamer::factors
