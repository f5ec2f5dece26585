#pragma once

#include "common/transport/factor_sources.h"
#include "common/transport/factor_table.h"

namespace metamer::factors {

/// A material's diffuse spectrum.
struct Diffuse {
  using Table = SpectrumTable;
  static std::size_t count(const FactorSources& sources) { return sources.materials.size(); }
  static const Spectrum* source(const FactorSources& sources, std::uint32_t material) {
    return sources.materials[material].diffuse;
  }
};

}  // namespace metamer::factors
