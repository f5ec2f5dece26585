#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "server/service/executors/slurm/command.h"
#include "server/service/executors/slurm/squeue.h"

namespace metamer::service {

/// Tasks that are submitted together.
struct Submission {
  std::string name;
  std::uint32_t count = 0;
  /// Where the orders lie, "0.order" and so on, and what the tasks say.
  std::filesystem::path folder;
  std::int32_t nice = 0;  ///< As sbatch --nice has it: what is above runs later.
};

/// Slurm, by its command line. Each call waits for a program, so none is for the service's thread.
/// Errors say what Slurm says.
class SlurmCommands {
 public:
  struct Options {
    std::filesystem::path worker;        ///< The program, at the same path on each node.
    std::uint32_t threads = 1;           ///< Of a task, each a CPU of Slurm's.
    bool unconfined = false;             ///< As metamerd has it.
    std::vector<std::string> arguments;  ///< More words for sbatch: "--partition=render".
    std::string gres = {};               ///< Of a task, as sbatch has it: "gpu:1"; empty: none.
    std::string gl_device = {};          ///< As a worker has it, of GL's tasks; empty: of others.
  };
  /// `cancelled` ends whatever runs.
  SlurmCommands(Options options, const std::atomic<bool>& cancelled)
      : options_(std::move(options)), cancelled_(cancelled) {}

  /// An error may come of one that Slurm has taken all the same.
  Result<void> submit(const Submission& submission) const;
  /// The tasks whose names begin so.
  Result<std::vector<ListedTask>> list(std::string_view prefix) const;
  /// All tasks of these names; those that are none, or have ended, are no error. Also once
  /// `cancelled` is set. The first error ends it.
  Result<void> cancel(const std::vector<std::string>& names) const;

 private:
  Options options_;
  const std::atomic<bool>& cancelled_;
};

/// What sbatch runs: the worker, by the order of its place in the array.
std::string batch_script(const SlurmCommands::Options& options,
                         const std::filesystem::path& folder);

}  // namespace metamer::service
