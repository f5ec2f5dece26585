#pragma once

#include <filesystem>
#include <string>

namespace metamer::batch {

/// How a task of a cluster is started: metamer-worker --batch FILE.
struct BatchOptions {
  std::filesystem::path order;    ///< A BatchOrder.
  std::filesystem::path program;  ///< This one, for the worker that it starts.
  unsigned threads = 1;
  bool unconfined = false;
  std::string gl_device = {};  ///< Empty: by the CPU.
};

/// Reads the order, has a worker carry it out, and leaves the result in its place. Exit codes: 0 it
/// is there, whatever it says; 1 it is not, and stderr says why.
int run_batch(const BatchOptions& options);

}  // namespace metamer::batch
