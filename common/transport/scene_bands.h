#pragma once

#include <set>
#include <utility>

#include "common/color/chain_bands.h"
#include "common/transport/factor_kinds.h"

namespace metamer {

/// The bands of a scene (ChainBands), in which what an observer sees is a sum of products of values
/// of its factors: light · surface by sensors, a chain of factors as the product of their values at
/// the bands.
class SceneBands {
 public:
  /// Chains are of up to `depth` of the factors `passed` (kind and index). Factors of tables over
  /// an angle or a length may be on any chain, and a few of their nodes stand for all.
  SceneBands(const FactorSources& sources,
             const std::set<std::pair<FactorKind, std::uint32_t>>& passed, unsigned depth,
             const std::vector<const Spectrum*>& emissions, const Observer& observer);

  const ChainBands& bands() const { return bands_; }
  std::size_t lights() const { return sensors_.size(); }

  /// Whether factors of the kind are lines between bands().edges.
  static bool is_linear(FactorKind kind);

  /// A sensor a band for a light of luminance 1, of `surface` by edge. Of a surface that is no
  /// line, what it is at the bands multiplies the sensors of white.
  std::vector<double> sensors(std::size_t light, std::span<const float> surface) const {
    return sensors_[light].of(surface);
  }

 private:
  ChainBands bands_;
  std::vector<SurfaceSensors> sensors_;  ///< By emission.
};

}  // namespace metamer
