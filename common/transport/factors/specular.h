#pragma once

#include "common/transport/factor_sources.h"
#include "common/transport/factor_table.h"

namespace metamer::factors {

/// A material's specular spectrum C_S: its reflection at normal incidence, where it has no exact
/// Fresnel term.
struct Specular {
  using Table = SpectrumTable;
  static std::size_t count(const FactorSources& sources) { return sources.materials.size(); }
  static const Spectrum* source(const FactorSources& sources, std::uint32_t material) {
    return sources.materials[material].specular;
  }
};

}  // namespace metamer::factors
