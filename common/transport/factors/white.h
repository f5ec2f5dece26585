#pragma once

#include "common/transport/factor_sources.h"
#include "common/transport/factor_table.h"

namespace metamer::factors {

/// 1 at every wavelength.
struct White {
  using Table = SpectrumTable;
  static std::size_t count(const FactorSources&) { return 1; }
  static const Spectrum* source(const FactorSources&, std::uint32_t) {
    static const Spectrum one{{550}, {1}};
    return &one;
  }
};

}  // namespace metamer::factors
