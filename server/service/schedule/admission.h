#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace metamer::service {

/// What is known of a job, or a view, that says how much memory it takes.
struct JobSize {
  std::uint64_t asset_bytes = 0;  ///< Of all its files.
  std::uint64_t scene_bytes = 0;  ///< Of them the scene's own, as the wire has it.
  std::uint64_t pixels = 0;       ///< 0: it has no plan yet.
  // As planned; from the bytes before.
  std::uint64_t triangles = 0;
  std::uint64_t spectra = 0;  ///< Distinct ones,
  std::uint64_t bands = 0;    ///< and what the method keeps of each.
  bool keeps_factors = false;
  // By the heads of textures and environments (common/picture_head.h).
  std::uint64_t picture_values = 0;   ///< Of all together,
  std::uint64_t largest_picture = 0;  ///< and of the one that has most.
};

/// Bytes that a job takes of worker and daemon while it runs: an estimate, rather too high. It
/// never overflows.
std::uint64_t memory_estimate(const JobSize& size);

/// Bytes of its own that a worker of so many threads may take for a job, more than it has without
/// one; what it takes beyond ends it. It is more than is admitted: the estimate is of memory that
/// is used, and this of memory that is asked for, by a driver as well.
std::uint64_t memory_allowance(const JobSize& size, std::uint32_t threads,
                               std::uint64_t driver_bytes = 0);

/// In the unit that people use of memory, rounded up: "161 MiB".
std::string mib(std::uint64_t bytes);

/// Whether a job may start now.
struct Admission {
  enum class Verdict {
    starts,
    waits,  ///< Until others have ended.
    never,  ///< It is more than all of the memory.
  };
  Verdict verdict = Verdict::starts;
  std::string reason;  ///< Why not; for people.
};

/// A job that takes `wanted` bytes beside others that take `taken` of `budget`; budget 0: whatever
/// it takes.
Admission admit(std::uint64_t wanted, std::uint64_t taken, std::uint64_t budget);

/// Why a view of that size can't be open beside what takes `taken` of `budget`, and what of it is
/// the most; a view does not wait. Nothing: it can.
std::optional<std::string> refuse_view(const JobSize& size, std::uint64_t taken,
                                       std::uint64_t budget);

}  // namespace metamer::service
