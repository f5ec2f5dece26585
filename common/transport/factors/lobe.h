#pragma once

#include "common/scene/rough_lobe_table.h"
#include "common/transport/factor_sources.h"
#include "common/transport/factor_table.h"

namespace metamer::factors {

/// A lobe of a rough material whose geometry depends on wavelength (He et al., 1991): its Fresnel
/// term, times a polynomial of wavelength of which a renderer has the weights (rough_lobe_table.h).
/// A node is a cosine's and a wavelength's. Of terms; a renderer names nodes, and no place.
struct Lobe {
  struct Table {
    static constexpr std::uint32_t nodes = lobe_cosines * lobe_wavelengths;
    static FactorTable make(const FactorSources::Material& material,
                            const std::vector<double>& nm) {
      return [table = RoughLobeTable(material.constants, *material.specular, nm)](
                 std::uint32_t node) { return table.values(node); };
    }
    /// At right angles, some of the polynomials.
    static std::vector<std::uint32_t> typical(const FactorSources::Material&) {
      const std::uint32_t last = (lobe_cosines - 1) * lobe_wavelengths;
      return {last, last + 2, last + 4, last + lobe_wavelengths - 1};
    }
  };
  static std::size_t count(const FactorSources& sources) { return sources.materials.size(); }
  static const FactorSources::Material* source(const FactorSources& sources,
                                               std::uint32_t material) {
    const FactorSources::Material& own = sources.materials[material];
    return own.is_rough ? &own : nullptr;
  }
};

}  // namespace metamer::factors
