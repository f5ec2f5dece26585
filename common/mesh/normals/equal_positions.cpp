#include "common/mesh/normals/equal_positions.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>

#include "common/mesh/parallel.h"
#include "common/mesh/vertex.h"

namespace metamer {
namespace {

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

/// Vertices by the hash of their places, with half of it to tell them apart; all threads fill it.
class PlaceTable {
 public:
  explicit PlaceTable(const MeshFile& mesh)
      : mesh_(mesh), slots_(std::bit_ceil(vertex_count(mesh) * 3 / 2 + 1)) {}

  void prefetch(std::uint64_t hash) const { __builtin_prefetch(&slots_[slot_of(hash)], 1); }

  /// The vertex that is at the place of `vertex`, which is added where none is.
  std::uint32_t find_or_add(std::uint32_t vertex, std::uint64_t hash) {
    const std::uint64_t mark = hash << 32;
    for (std::size_t slot = slot_of(hash);; slot = (slot + 1) & (slots_.size() - 1)) {
      std::uint64_t there = 0;  // A vertex is one more than its number.
      if (slots_[slot].compare_exchange_strong(there, mark | (vertex + 1),
                                               std::memory_order_relaxed))
        return vertex;
      const auto other = static_cast<std::uint32_t>(there) - 1;
      if (there >> 32 == mark >> 32 && position(mesh_, other) == position(mesh_, vertex))
        return other;
    }
  }

 private:
  std::size_t slot_of(std::uint64_t hash) const { return (hash >> 32) & (slots_.size() - 1); }

  const MeshFile& mesh_;
  std::vector<std::atomic<std::uint64_t>> slots_;  ///< Open addressing; 0: free.
};

constexpr std::uint32_t no_vertex = 0xFFFFFFFF;
constexpr std::size_t ahead = 32;  // Slots that are fetched while others are looked at.

}  // namespace

std::vector<std::uint32_t> equal_positions(const MeshFile& mesh) {
  PlaceTable table(mesh);
  std::vector<std::uint32_t> same(vertex_count(mesh));
  std::atomic<bool> any{false};
  for_ranges(same.size(), [&](std::size_t begin, std::size_t end) {
    std::array<std::uint64_t, ahead> hashes;
    bool found = false;
    for (std::size_t first = begin; first < end; first += ahead) {
      const std::size_t count = std::min(ahead, end - first);
      for (std::size_t i = 0; i < count; ++i)
        table.prefetch(hashes[i] = hash_of(position(mesh, first + i)));
      for (std::size_t i = 0; i < count; ++i) {
        const auto vertex = static_cast<std::uint32_t>(first + i);
        same[vertex] = table.find_or_add(vertex, hashes[i]);
        found = found || same[vertex] != vertex;
      }
    }
    if (found) any = true;
  });
  if (!any) return {};
  // Whichever thread came first: the first in the file stands for them all.
  std::vector<std::uint32_t> first(same.size(), no_vertex);
  for (std::uint32_t vertex = 0; vertex < same.size(); ++vertex) {
    std::uint32_t& known = first[same[vertex]];
    known = std::min(known, vertex);
    same[vertex] = known;
  }
  return same;
}

}  // namespace metamer
