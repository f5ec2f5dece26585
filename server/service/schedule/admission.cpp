#include "server/service/schedule/admission.h"

#include <algorithm>
#include <array>
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
/// Of materials and objects, for each byte of the scene: a hundred thousand ellipsoids, of 90 bytes
/// and each a hierarchy of its own, take 5.5 KiB each.
constexpr std::uint64_t bytes_per_scene_byte = 64;
/// Of each number of a texture or an environment: 16 bits and its smaller copies, or one in f32.
/// While one is read it is there in f32, as colours, too, and twice as a texture.
constexpr std::uint64_t bytes_per_picture_value = 4;
constexpr std::uint64_t reading_bytes_per_value = 8;
/// Of a spectrum while a method is made for it, beside its bands: a row of the basis in f64, twice.
constexpr std::uint64_t bytes_per_spectrum = 24u << 10;
constexpr std::uint64_t bytes_per_band = 4;
/// X Y Z in f32, of the worker and of the daemon.
constexpr std::uint64_t bytes_per_pixel = 24;
/// And of factors, serialised, of a scene whose mirrors do not face each other.
constexpr std::uint64_t factor_bytes_per_pixel = 64;

/// What may be asked for beyond the estimate. Of the gallery, the booth, meshes and scenes at the
/// ends of the limits (tests/bench/memory_bench.py) the CPU's jobs used 0.93 of the estimate at
/// most and asked for 0.97; software's GL, which asks for more than it uses, for 1.7, of which 100
/// MiB are the same for all scenes. None asked for more than half of what is allowed.
constexpr std::uint64_t allowed_share = 2;
constexpr std::uint64_t allowed_bytes = std::uint64_t{256} << 20;
/// Stacks are asked for whole.
constexpr std::uint64_t allowed_bytes_per_thread = 8u << 20;

constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();

std::uint64_t added(std::uint64_t a, std::uint64_t b) { return a > most - b ? most : a + b; }

std::uint64_t times(std::uint64_t count, std::uint64_t bytes) {
  return bytes != 0 && count > most / bytes ? most : count * bytes;
}

struct Part {
  const char* what;
  std::uint64_t bytes = 0;
};

std::array<Part, 7> parts_of(const JobSize& size) {
  const bool planned = size.pixels > 0;
  const std::uint64_t files = size.asset_bytes - std::min(size.scene_bytes, size.asset_bytes);
  return {
      {{"the worker itself", worker_bytes},
       {"its objects and materials", times(size.scene_bytes, bytes_per_scene_byte)},
       {"its files", planned ? size.asset_bytes : times(files, bytes_per_asset_byte)},
       {"its textures", added(times(size.picture_values, bytes_per_picture_value),
                              times(size.largest_picture, reading_bytes_per_value))},
       {"its triangles", planned ? times(size.triangles, bytes_per_triangle) : 0},
       {"its spectra", added(times(size.spectra, bytes_per_spectrum),
                             times(times(size.spectra, bytes_per_band), size.bands))},
       {"its picture",
        times(size.pixels, bytes_per_pixel + (size.keeps_factors ? factor_bytes_per_pixel : 0))}}};
}

}  // namespace

std::string mib(std::uint64_t bytes) {
  constexpr std::uint64_t unit = std::uint64_t{1} << 20;
  return std::to_string(bytes / unit + (bytes % unit != 0)) + " MiB";
}

std::uint64_t memory_estimate(const JobSize& size) {
  std::uint64_t bytes = 0;
  for (const Part& part : parts_of(size)) bytes = added(bytes, part.bytes);
  return bytes;
}

std::optional<std::string> refuse_view(const JobSize& size, std::uint64_t taken,
                                       std::uint64_t budget) {
  const std::uint64_t wanted = memory_estimate(size);
  const Admission may = admit(wanted, taken, budget);
  if (may.verdict == Admission::Verdict::starts) return std::nullopt;
  const auto parts = parts_of(size);
  const Part& largest = *std::max_element(
      parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.bytes < b.bytes; });
  std::string text = "the view takes about " + mib(wanted) + " of memory, most of it for " +
                     largest.what + ", and ";
  if (may.verdict == Admission::Verdict::never)
    return text + "jobs and views may have " + mib(budget) + " (--memory)";
  return text + "of " + mib(budget) + " others have " + mib(taken);
}

std::uint64_t memory_allowance(const JobSize& size, std::uint32_t threads,
                               std::uint64_t driver_bytes) {
  const std::uint64_t fixed = added(allowed_bytes, times(threads, allowed_bytes_per_thread));
  return added(times(memory_estimate(size), allowed_share), added(fixed, driver_bytes));
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
