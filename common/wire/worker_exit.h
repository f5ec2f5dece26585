#pragma once

#include <string>

namespace metamer::wire {

/// With this code a worker ends to which the system has refused memory: RLIMIT_DATA, which metamerd
/// sets, or the machine's own end. It says nothing before, since that takes memory too.
inline constexpr int exit_out_of_memory = 12;

// What waitpid says of a worker that is gone.

/// "killed by signal 9 (Killed)", "exited with code 3" or "ran out of memory".
std::string describe_exit(int wait_status);

/// It ended since the system refused it memory, as its exit code says; or was killed where `kernel`
/// has ended a process for want of memory.
bool is_out_of_memory(int wait_status, bool kernel = false);

}  // namespace metamer::wire
