#pragma once

#include "client/cli/names.h"

namespace metamer::cli {

/// What the program says to the shell; README.md and --help list the same.
enum class ExitCode : int {
  done = 0,
  /// Anything that has no number of its own: the disk is full, say; of `compare`, that the pictures
  /// differ by more than --max.
  other = 1,
  bad_input = 2,  ///< Bad input or usage.
  no_server = 3,  ///< No server there, or it was lost.
  job_failed = 4,
  cancelled = 5,
  promise_broken = 6,  ///< The picture is there, and is not as accurate, or as quick, as asked for.
};

}  // namespace metamer::cli
