#pragma once

#include <array>
#include <cstddef>

#include "metamer/v1/plan.pb.h"

namespace metamer::worker {

/// What a job's time goes into. `others` is told to nobody: between steps, and views' turns.
enum class Phase { compile, acceleration, pilot, prepare, render, verify, others };
inline constexpr std::size_t phase_count = 7;

/// Sums up a job's time by phase: the clock's, and that of all threads of this process
/// (CLOCK_PROCESS_CPUTIME_ID), whatever they did. Phases part the time: one that begins within
/// another takes its time from it. For one thread.
class RunClock {
 public:
  /// From its making to its end time is this phase's.
  class Span {
   public:
    Span(RunClock& clock, Phase phase) : clock_(clock), before_(clock.enter(phase)) {}
    ~Span() { clock_.enter(before_); }
    Span(const Span&) = delete;

   private:
    RunClock& clock_;
    Phase before_;
  };

  RunClock();
  /// Adds those that came, up to this moment.
  void report(v1::RunRecord& record);

 private:
  struct Time {
    double seconds = 0, cpu_seconds = 0;
  };
  static Time now();
  Phase enter(Phase phase);

  Time since_;
  Phase phase_ = Phase::others;
  std::array<Time, phase_count> sums_{};
};

}  // namespace metamer::worker
