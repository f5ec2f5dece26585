#pragma once

#include "common/transport/factors/fresnel.h"

namespace metamer::factors {

/// What an interface between two media reflects, F(u; λ). Its table is over the cosine u on the
/// side of the lower index at the d line, where 0..1 are all angles that light gets through at:
/// Snell's law gives both sides of a ray the same place, and the same F (Born and Wolf, 1.5.2).
struct Reflect {
  using Table = Fresnel::Table;
  static std::size_t count(const FactorSources& sources) { return sources.interfaces.size(); }
  static const OpticalConstants* source(const FactorSources& sources, std::uint32_t interface) {
    return sources.interfaces[interface];
  }
  static FresnelPlace place(float cosine) { return fresnel_place(cosine); }
};

}  // namespace metamer::factors
