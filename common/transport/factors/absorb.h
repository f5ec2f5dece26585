#pragma once

#include "common/scene/absorption_table.h"
#include "common/transport/factor_sources.h"
#include "common/transport/factor_table.h"

namespace metamer::factors {

/// What a material lets through of light on its way in it, exp(−a(λ) d) (Beer and Lambert); its
/// table is over the optical length (absorption_table.h).
struct Absorb {
  struct Table {
    static constexpr std::uint32_t nodes = absorption_nodes;
    static FactorTable make(const Spectrum& transmittance, const std::vector<double>& nm) {
      return [depth = relative_depth(transmittance, nm)](std::uint32_t node) {
        return transmitted(depth, absorption_node(node));
      };
    }
    /// A few lengths that stand for all: about one and three of the thickness that was measured.
    static std::vector<std::uint32_t> typical(const Spectrum& transmittance) {
      const double once = optical_depth(transmittance);
      return {absorption_place(static_cast<float>(once)).below,
              absorption_place(static_cast<float>(3 * once)).below};
    }
  };
  static std::size_t count(const FactorSources& sources) { return sources.materials.size(); }
  static const Spectrum* source(const FactorSources& sources, std::uint32_t material) {
    return sources.materials[material].transmittance;
  }
  static AbsorptionPlace place(float length) { return absorption_place(length); }
};

}  // namespace metamer::factors
