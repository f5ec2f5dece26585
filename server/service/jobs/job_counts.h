#pragma once

#include <cstdint>
#include <map>

#include "metamer/v1/jobs.pb.h"

namespace metamer::service {

/// What has become of all jobs since the daemon's start.
struct JobCounts {
  std::uint64_t submitted = 0;
  std::uint64_t finished = 0, failed = 0, cancelled = 0;
  std::map<v1::Backend, std::uint64_t> tiles, rays;
  std::map<v1::Backend, double> worker_seconds;
};

}  // namespace metamer::service
