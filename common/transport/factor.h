#pragma once

#include <compare>
#include <cstdint>

namespace metamer {

/// What multiplies light: see factors.def. The values are those of files, v1::FactorTerm.
enum class FactorKind : std::uint8_t {
#define METAMER_FACTOR(number, name, ...) name = number,
#include "common/transport/factors.def"
};

/// One of the finitely many things of a scene that multiply light, each a function of wavelength:
/// the `node`-th of the table of a kind's `index`-th member. White and spectra have one node.
struct FactorNode {
  FactorKind kind;
  std::uint32_t index;  ///< What of the scene: of white 0, an interface, a bundle, else a material.
  std::uint32_t node;

  friend auto operator<=>(const FactorNode&, const FactorNode&) = default;
};

/// What light meets on its way: a kind's `index`-th member at a place of its table, between two
/// nodes.
struct Factor {
  FactorKind kind;
  std::uint32_t index;
  /// Of `specular` and `fresnel`, the cosine of incidence in 0..1; of `reflect` and `transmit` that
  /// on the rarer side; of `absorb` the strongest wavelength's optical depth; else not used.
  float at;

  friend bool operator==(const Factor&, const Factor&) = default;
};

}  // namespace metamer
