#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "common/problem.h"

namespace metamer::service {

/// What a program may take.
struct CommandLimits {
  std::chrono::milliseconds time{10'000};
  std::size_t bytes = 64u << 20;  ///< Of what it says, on stdout and on stderr.
};

/// Runs a program that is found in PATH, with no more of our environment than finds Slurm; gives it
/// `input` (at most what a pipe holds, 64 KiB) and waits for its end. Not on the service's thread.
/// Gives what it said on stdout. Errors: it can't be started; takes or says too much, and is ended;
/// `cancelled` was set; ended with another code than 0, with the first line of its stderr.
Result<std::string> run_command(const std::vector<std::string>& words, std::string_view input,
                                const CommandLimits& limits, const std::atomic<bool>& cancelled);

}  // namespace metamer::service
