#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "common/problem.h"

namespace metamer::service {

/// Where this process's control group (v2) is, if it has been delegated to it with the memory in
/// it: systemd's Delegate=memory. Errors: why there is none, for people.
Result<std::filesystem::path> delegated_control_group();

/// Divides a delegated group: this process moves into a group below it, since one that hands memory
/// on has no processes of its own, and those of lanes may be made. Errors: what can't be written.
Result<void> divide_control_group(const std::filesystem::path& group);

/// The group of a lane's processes, its worker and the readers of meshes: what they take together,
/// with pictures, which RLIMIT_DATA does not count, stays below what jobs may take. Beyond, the
/// kernel ends one of them, and none of anybody else's.
class ControlGroup {
 public:
  ControlGroup() = default;  ///< None: it holds nothing.
  /// Makes it, below one that is divided, or takes the one that is there.
  ControlGroup(const std::filesystem::path& divided, std::string lane);

  /// For a worker, which enters it before it starts others; empty: there is none.
  const std::filesystem::path& path() const { return path_; }
  /// Of memory, for all its processes. False: the system refuses, and nothing is held.
  bool allow(std::uint64_t bytes) const;
  /// Processes in it that the kernel has ended for want of memory, so far.
  std::uint64_t ended_for_memory() const;

 private:
  std::filesystem::path path_;
};

}  // namespace metamer::service
