#include "server/service/schedule/admission.h"

#include <algorithm>
#include <limits>

namespace metamer::service {

namespace {

/// Of a worker with an empty scene, its tables and threads.
constexpr std::uint64_t worker_bytes = std::uint64_t{64} << 20;
/// Of the arrays and the hierarchy of a mesh, for each byte of its file: binary STL has 50 bytes a
/// triangle, and is the densest that is read.
constexpr std::uint64_t bytes_per_asset_byte = 8;
/// The same for each triangle, where they are counted.
constexpr std::uint64_t bytes_per_triangle = 320;
/// X Y Z in f32, of the worker and of the daemon.
constexpr std::uint64_t bytes_per_pixel = 24;
/// And of factors, serialised, of a scene whose mirrors do not face each other.
constexpr std::uint64_t factor_bytes_per_pixel = 64;

constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();

std::uint64_t added(std::uint64_t a, std::uint64_t b) { return a > most - b ? most : a + b; }

std::uint64_t times(std::uint64_t count, std::uint64_t bytes) {
  return count > most / bytes ? most : count * bytes;
}

/// In the unit that people use of memory; rounded up.
std::string mib(std::uint64_t bytes) {
  constexpr std::uint64_t unit = std::uint64_t{1} << 20;
  return std::to_string(bytes / unit + (bytes % unit != 0)) + " MiB";
}

}  // namespace

std::uint64_t memory_estimate(const JobSize& size) {
  const bool planned = size.pixels > 0;
  std::uint64_t bytes = added(
      worker_bytes, planned ? added(size.asset_bytes, times(size.triangles, bytes_per_triangle))
                            : times(size.asset_bytes, bytes_per_asset_byte));
  bytes = added(bytes, times(size.pixels, bytes_per_pixel));
  if (size.keeps_factors) bytes = added(bytes, times(size.pixels, factor_bytes_per_pixel));
  return bytes;
}

Admission admit(std::uint64_t wanted, std::uint64_t taken, std::uint64_t budget) {
  if (budget == 0 || added(wanted, taken) <= budget) return {};
  if (wanted > budget)
    return {Admission::Verdict::never, "it takes about " + mib(wanted) +
                                           " of memory, and jobs may have " + mib(budget) +
                                           " (--memory)"};
  return {Admission::Verdict::waits, "waits for memory: it takes about " + mib(wanted) +
                                         ", and of " + mib(budget) + " others have " + mib(taken)};
}

}  // namespace metamer::service
