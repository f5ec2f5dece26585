#pragma once

#include <chrono>

namespace metamer::fuzz {

/// The steady clock of this program stands still but for this: the daemon's time-outs take no time,
/// and a run is the same again. (It is clock_gettime that is replaced, for CLOCK_MONOTONIC.)
void advance_clock(std::chrono::milliseconds by);

}  // namespace metamer::fuzz
