#include "common/mesh/equal_positions.h"

#include <atomic>
#include <bit>

#include "common/mesh/parallel.h"
#include "common/mesh/vertex.h"

namespace metamer {
namespace {

constexpr std::uint32_t free_slot = 0xFFFFFFFF;

/// Mixes a place's bits (Appleby's MurmurHash3, its finalizer).
std::uint64_t hash_of(const Double3& place) {
  std::uint64_t hash = 0;
  for (const double coordinate : place) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(coordinate + 0.0)) * 0xFF51AFD7ED558CCDu;
    hash = (hash ^ (hash >> 33)) * 0xC4CEB9FE1A85EC53u;
    hash ^= hash >> 33;
  }
  return hash;
}

}  // namespace

std::vector<std::uint32_t> equal_positions(const MeshFile& mesh) {
  // A table of vertices by the hash of their places, which all threads fill: open addressing.
  const std::size_t count = vertex_count(mesh);
  const std::size_t slots = std::bit_ceil(count + count / 2 + 1);
  std::vector<std::uint32_t> table(slots, free_slot), same(count);
  std::atomic<bool> any{false};
  for_ranges(count, [&](std::size_t begin, std::size_t end) {
    bool found = false;
    for (std::size_t i = begin; i < end; ++i) {
      const Double3 place = position(mesh, i);
      const auto number = static_cast<std::uint32_t>(i);
      std::size_t slot = hash_of(place) & (slots - 1);
      std::uint32_t there = free_slot;
      while (!std::atomic_ref(table[slot])
                  .compare_exchange_strong(there, number, std::memory_order_relaxed) &&
             position(mesh, there) != place) {
        slot = (slot + 1) & (slots - 1);
        there = free_slot;
      }
      same[i] = there == free_slot ? number : there;
      found = found || same[i] != number;
    }
    if (found) any = true;
  });
  if (!any) same.clear();
  return same;
}

}  // namespace metamer
