#pragma once

#include "common/transport/factor_sources.h"
#include "common/transport/factor_table.h"

namespace metamer::factors {

/// What a material's fluorescence makes of a light: another light, by reradiated(). Nothing
/// multiplies that: 1. As it stands in a light's place, it is a factor of terms and of no chain.
struct Reradiate {
  struct Table {
    static constexpr std::uint32_t nodes = 1;
    static FactorTable make(const Fluorescence&, const std::vector<double>& nm) {
      return [count = nm.size()](std::uint32_t) { return std::vector<double>(count, 1.0); };
    }
  };
  static std::size_t count(const FactorSources& sources) { return sources.materials.size(); }
  static const Fluorescence* source(const FactorSources& sources, std::uint32_t material) {
    return sources.materials[material].fluorescence;
  }
};

}  // namespace metamer::factors
