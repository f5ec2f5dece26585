#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>

namespace metamer::service {

/// What one worker may take of memory that it shares with nobody: heap, stacks, a driver's own
/// (RLIMIT_DATA). Not RLIMIT_AS, which counts mapped files, the picture's memory and what a driver
/// or an allocator reserves and never touches. The readers of meshes are processes of their own and
/// have limits of their own (server/import/bounds.h).
///
/// The limit is on top of what the worker has when it is ready, libraries and a driver's tables. It
/// is the soft one, so that the next job gets its own; the sandbox keeps a worker from raising it.
class MemoryLimit {
 public:
  MemoryLimit() = default;  ///< Of no worker: nothing is limited.
  /// Of a worker that is ready.
  explicit MemoryLimit(pid_t worker);

  /// From now on the worker may have `bytes` more than it had when it was ready. What it has
  /// already stays: beyond the limit it gets no more.
  void allow(std::uint64_t bytes);

  /// For people: "limited by the system", or "not limited" and why.
  std::string describe() const;

 private:
  pid_t worker_ = -1;
  std::uint64_t own_ = 0;  // bytes that it had
  std::string lacks_;
};

/// Bytes that a process counts against RLIMIT_DATA; 0: it is not there, or may not be looked at.
std::uint64_t data_bytes(pid_t process);

}  // namespace metamer::service
