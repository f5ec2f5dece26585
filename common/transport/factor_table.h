#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "common/spectral/spectrum.h"

namespace metamer {

/// A factor's values at some wavelengths, by node.
using FactorTable = std::function<std::vector<double>(std::uint32_t node)>;

/// The table of a spectrum has one node. End values hold outside.
struct SpectrumTable {
  static constexpr std::uint32_t nodes = 1;
  static FactorTable make(const Spectrum& spectrum, const std::vector<double>& nm) {
    return
        [values = resample(spectrum, nm, Outside::hold).values](std::uint32_t) { return values; };
  }
};

}  // namespace metamer
