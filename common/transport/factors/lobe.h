#pragma once

#include <algorithm>

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
    /// What stands for all nodes where wavelengths are chosen: at right angles, some of the
    /// polynomials above 1, since no lobe is one of them alone, and none by itself may be below 0.
    static std::vector<Spectrum> typical_last(const FactorSources::Material& material,
                                              const std::vector<double>& nm) {
      const RoughLobeTable table(material.constants, *material.specular, nm);
      std::vector<double> fresnel(nm.size());
      std::vector<Spectrum> all;
      for (std::uint32_t w = 0; w < lobe_wavelengths; ++w) {
        all.push_back({nm, table.values((lobe_cosines - 1) * lobe_wavelengths + w)});
        for (std::size_t i = 0; i < nm.size(); ++i) fresnel[i] += all.back().values[i];
      }
      for (Spectrum& one : all)
        for (std::size_t i = 0; i < nm.size(); ++i)
          one.values[i] = std::max(one.values[i] + fresnel[i], 0.0);
      return {all[0], all[2], all[4], all[7]};
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
