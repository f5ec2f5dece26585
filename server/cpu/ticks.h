#pragma once

#include <x86intrin.h>

#include <algorithm>
#include <cstdint>

#include "server/cpu/packet.h"

/// The processor's time stamp: cheap enough to time a piece of a ray. Only ratios mean anything.
namespace metamer::cpu {

inline std::uint64_t ticks() { return __rdtsc(); }

/// One in so many evaluations of models is timed (Workspace::timed_ticks).
inline constexpr std::uint64_t timed_each = 64;

/// An estimate of the ticks that a thread has spent in models, without those of looking at the
/// clock.
inline std::uint64_t model_ticks(const Workspace& workspace) {
  std::uint64_t least = ~std::uint64_t{0};
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t start = ticks();
    least = std::min(least, ticks() - start);
  }
  const std::uint64_t timed = (workspace.evaluations + timed_each - 1) / timed_each;
  return (workspace.timed_ticks - std::min(workspace.timed_ticks, timed * least)) * timed_each;
}

}  // namespace metamer::cpu
