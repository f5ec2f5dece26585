#pragma once

namespace metamer::wire {

/// With this code a worker ends to which the system has refused memory: RLIMIT_DATA, which metamerd
/// sets, or the machine's own end. It says nothing before, since that takes memory too.
inline constexpr int exit_out_of_memory = 12;

}  // namespace metamer::wire
