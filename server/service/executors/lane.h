#pragma once

#include <cstdint>

#include "metamer/v1/scene.pb.h"

namespace metamer::service {

/// What a worker is for: what happens to it happens to nothing else.
struct Lane {
  const char* name;  ///< For people, and in WorkerInfo.
  v1::Backend backend = v1::CPU;
  bool jobs = false;
  bool views = false;
  /// As nice(2) has it. A frame is waited for, a tile is not: on the processors that they share
  /// jobs get what views leave, at least a tenth.
  int niceness = 0;
  /// Bytes that a driver may ask for besides its jobs: its compiler, and copies of what is on a
  /// device.
  std::uint64_t driver_bytes = 0;
};

inline constexpr Lane cpu_jobs{"cpu", v1::CPU, true, false, 10};
inline constexpr Lane cpu_views{"cpu views", v1::CPU, false, true, 0};
/// One device draws one thing after the other, so both have turns in one worker.
inline constexpr Lane gl_lane{"gl", v1::GL, true, true, 0, std::uint64_t{1} << 30};
/// The same without jobs, where a cluster draws these.
inline constexpr Lane gl_views{"gl views", v1::GL, false, true, 0, std::uint64_t{1} << 30};

}  // namespace metamer::service
