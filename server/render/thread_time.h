#pragma once

#include <ctime>

namespace metamer {

/// Seconds that the calling thread has computed: on a machine that does other things as well, what
/// they would be on an idle one.
inline double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace metamer
