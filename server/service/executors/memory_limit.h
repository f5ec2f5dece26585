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
/// The limit is on top of what the worker has when a job begins: libraries, a driver's tables, and
/// what is left of earlier jobs, which the C library keeps for the next. It is the soft one, so
/// that the next job gets its own; the sandbox keeps a worker from raising it.
class MemoryLimit {
 public:
  MemoryLimit() = default;  ///< Of no worker: nothing is limited.
  /// Of a worker that is ready.
  explicit MemoryLimit(pid_t worker);

  /// A job begins: its limits are on top of what the worker has now, but of what others have left
  /// in it no more than `most_left`.
  void begin(std::uint64_t most_left);
  /// From now on the worker may have `bytes` more than it had when its job began. What it has
  /// already stays: beyond the limit it gets no more.
  void allow(std::uint64_t bytes);

  /// For people: "limited for each job", or "not limited: " and why.
  std::string describe() const;

 private:
  pid_t worker_ = -1;
  std::uint64_t own_ = 0;   // bytes that it had when it was ready,
  std::uint64_t base_ = 0;  // and when its job began
  std::string lacks_;
};

/// Bytes that a process counts against RLIMIT_DATA; 0: it is not there, or may not be looked at.
std::uint64_t data_bytes(pid_t process);

}  // namespace metamer::service
