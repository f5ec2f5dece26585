#pragma once

#include <cstdint>

#include "server/cpu/lanes.h"

/// Points in the unit square, the fixed pattern by which lights with a surface are looked at: the
/// first two dimensions of I. M. Sobol' (1967), a (0, 2)-sequence in base 2: each 2^k points from a
/// multiple of 2^k on have one in each elementary interval. They are scrambled after A. B. Owen
/// (1995) by the hash of B. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020.
namespace metamer::cpu::soft {

/// A number of its own for each pair.
inline std::uint32_t hashed(std::uint32_t a, std::uint32_t b) {
  // C. Wellons's triple32, which has no bias above 2^-12.
  std::uint32_t x = a * 0x9e3779b9U ^ (b + 0x7f4a7c15U);
  x = (x ^ (x >> 17)) * 0xed5ad4bbU;
  x = (x ^ (x >> 11)) * 0xac4c1b51U;
  x = (x ^ (x >> 15)) * 0x31848babU;
  return x ^ (x >> 14);
}

/// In [0, 1) each.
struct Points {
  Floats u{}, v{};
};

/// The point number `index` of a lane's scrambled sequence, which `seed` chooses.
struct Pattern {
  std::uint32_t index, seed;
  /// Sets one lane.
  void put(Points& point, unsigned lane) const;
  /// The same points in an order of the seed's own, each 2^k from a multiple of 2^k on together
  /// (Burley, 3.1): without it they would go with those of another pattern of the same numbers.
  Pattern shuffled() const;
};

}  // namespace metamer::cpu::soft
