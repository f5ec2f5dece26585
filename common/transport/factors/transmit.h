#pragma once

#include "common/transport/factors/reflect.h"

namespace metamer::factors {

/// What an interface between two media lets through, 1 − F(u; λ), of the radiance by n²: that is
/// the same on both sides. Its places are those of `reflect`.
struct Transmit {
  struct Table {
    static constexpr std::uint32_t nodes = fresnel_nodes;
    static FactorTable make(const OpticalConstants& constants, const std::vector<double>& nm) {
      return [reflect = Reflect::Table::make(constants, nm)](std::uint32_t node) {
        std::vector<double> values = reflect(node);
        for (double& value : values) value = 1 - value;
        return values;
      };
    }
  };
  static std::size_t count(const FactorSources& sources) { return Reflect::count(sources); }
  static const OpticalConstants* source(const FactorSources& sources, std::uint32_t interface) {
    return Reflect::source(sources, interface);
  }
  static FresnelPlace place(float cosine) { return fresnel_place(cosine); }
};

}  // namespace metamer::factors
