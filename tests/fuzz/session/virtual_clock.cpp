#include "virtual_clock.h"

#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <ctime>

namespace {

constexpr std::int64_t second = 1'000'000'000;

/// Since the machine began, as it seems. The journal's thread asks too.
std::atomic<std::int64_t> nanoseconds{1'000'000 * second};

}  // namespace

// In the place of the C library's, for std::chrono and Asio alike.
extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
  if (clock != CLOCK_MONOTONIC) return static_cast<int>(::syscall(SYS_clock_gettime, clock, time));
  const std::int64_t now = nanoseconds;
  time->tv_sec = now / second;
  time->tv_nsec = now % second;
  return 0;
}

namespace metamer::fuzz {

void advance_clock(std::chrono::milliseconds by) {
  nanoseconds += std::chrono::nanoseconds(by).count();
}

}  // namespace metamer::fuzz
