#pragma once

#include <chrono>
#include <functional>

namespace metamer::service {

/// Seconds since 1970.
inline double wall_clock() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/// The same, where a test may have another.
using WallClock = std::function<double()>;

}  // namespace metamer::service
