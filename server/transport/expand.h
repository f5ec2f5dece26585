#pragma once

#include <array>
#include <concepts>
#include <cstddef>

#include "common/models/reference.h"
#include "common/transport/factor_kinds.h"
#include "server/models/lanes.h"

namespace metamer {

/// A weighted sum of one or two nodes: what makes a factor finite that depends on an angle or a
/// length.
template <class Real>
struct FactorNodes {
  std::array<FactorNode, 2> node;
  std::array<Real, 2> weight;
  std::size_t count;
};

/// A kind whose factors lie between two nodes, or on the one that they have.
template <class Real, class Kind>
FactorNodes<Real> expand(Kind, const Factor& factor) {
  if constexpr (requires { Kind::place(factor.at); }) {
    const auto [below, fraction] = Kind::place(factor.at);
    return {{{{factor.kind, factor.index, below}, {factor.kind, factor.index, below + 1}}},
            {1 - Real{fraction}, Real{fraction}},
            2};
  } else {
    return {{{{factor.kind, factor.index, 0}}}, {1, 0}, 1};
  }
}

/// C_S rises to white by Schlick's approximation, E[2.2-12].
template <class Real>
FactorNodes<Real> expand(factors::Specular, const Factor& factor) {
  Real rise;
  if constexpr (std::same_as<Real, float>)
    rise = models::schlick_rise(factor.at);
  else
    rise = models::schlick_fresnel(Real{factor.at}, 0);
  return {{{{factor.kind, factor.index, 0}, {FactorKind::white, 0, 0}}},
          {1 - rise, rise},
          rise == 0 ? std::size_t{1} : std::size_t{2}};
}

template <class Real>
FactorNodes<Real> expand(const Factor& factor) {
  return with_kind(factor.kind, [&](auto kind) { return expand<Real>(kind, factor); });
}

}  // namespace metamer
