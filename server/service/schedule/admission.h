#pragma once

#include <cstdint>
#include <string>

namespace metamer::service {

/// What is known of a job that says how much memory it takes.
struct JobSize {
  std::uint64_t asset_bytes = 0;  ///< Of all its files.
  std::uint64_t pixels = 0;       ///< 0: it has no plan yet.
  std::uint64_t triangles = 0;    ///< As planned; counted in asset_bytes before.
  bool keeps_factors = false;
};

/// Bytes that a job takes of worker and daemon while it runs: an estimate, rather too high. It
/// never overflows.
std::uint64_t memory_estimate(const JobSize& size);

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

}  // namespace metamer::service
