#pragma once

#include <chrono>

namespace metamer::service {

/// Seconds since 1970.
inline double wall_clock() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace metamer::service
