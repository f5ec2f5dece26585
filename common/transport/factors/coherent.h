#pragma once

#include "common/scene/rough_mirror_table.h"
#include "common/transport/factor_sources.h"
#include "common/transport/factor_table.h"

namespace metamer::factors {

/// What roughness leaves of a rough material's mirror, exp(−(4πs/λ)²) (He et al., 1991); its table
/// is over the depth s (rough_mirror_table.h), the same for all materials.
struct Coherent {
  struct Source {};
  struct Table {
    static constexpr std::uint32_t nodes = rough_mirror_nodes;
    static FactorTable make(const Source&, const std::vector<double>& nm) {
      return [nm](std::uint32_t node) { return rough_mirror(rough_mirror_node(node), nm); };
    }
    /// Where half of the light is lost; a chain's powers of it are deeper ones.
    static std::vector<std::uint32_t> typical(const Source&) {
      return {rough_mirror_place(0.036f).below};
    }
  };
  static std::size_t count(const FactorSources& sources) { return sources.materials.size(); }
  static const Source* source(const FactorSources& sources, std::uint32_t material) {
    static const Source one;
    return sources.materials[material].is_rough ? &one : nullptr;
  }
  /// Between which nodes a depth lies, µm.
  static RoughMirrorPlace place(float depth) { return rough_mirror_place(depth); }
};

}  // namespace metamer::factors
