#pragma once

#include "common/transport/factor_sources.h"
#include "common/transport/factor_table.h"

namespace metamer::factors {

/// A bundle of wavelengths that goes a way of its own: a hat function. The bundles of a scene are a
/// partition of unity.
struct Window {
  using Table = SpectrumTable;
  static std::size_t count(const FactorSources& sources) { return sources.windows.size(); }
  static const Spectrum* source(const FactorSources& sources, std::uint32_t bundle) {
    return sources.windows[bundle];
  }
};

}  // namespace metamer::factors
