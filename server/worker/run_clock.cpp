#include "server/worker/run_clock.h"

#include <ctime>
#include <utility>

namespace metamer::worker {
namespace {

constexpr std::array<const char*, phase_count - 1> phase_names = {
    "compile", "acceleration", "pilot", "prepare", "render", "verify"};

double seconds_of(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

RunClock::RunClock() : since_(now()) {}

RunClock::Time RunClock::now() {
  return {seconds_of(CLOCK_MONOTONIC), seconds_of(CLOCK_PROCESS_CPUTIME_ID)};
}

Phase RunClock::enter(Phase phase) {
  const Time time = now();
  Time& sum = sums_[static_cast<std::size_t>(phase_)];
  sum.seconds += time.seconds - since_.seconds;
  sum.cpu_seconds += time.cpu_seconds - since_.cpu_seconds;
  since_ = time;
  return std::exchange(phase_, phase);
}

void RunClock::report(v1::RunRecord& record) {
  enter(phase_);
  for (std::size_t i = 0; i < phase_names.size(); ++i) {
    if (sums_[i].seconds <= 0) continue;
    v1::PhaseTime& phase = *record.add_phase();
    phase.set_name(phase_names[i]);
    phase.set_seconds(sums_[i].seconds);
    phase.set_cpu_seconds(sums_[i].cpu_seconds);
  }
}

}  // namespace metamer::worker
