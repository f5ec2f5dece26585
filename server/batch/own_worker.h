#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "common/problem.h"
#include "metamer/v1/worker.pb.h"

namespace metamer::batch {

/// How a task's worker is started.
struct WorkerWords {
  std::filesystem::path program;
  std::filesystem::path store;  ///< The assets that it sees.
  unsigned threads = 1;
  bool unconfined = false;     ///< It may run where the kernel can't confine it.
  std::string gl_device = {};  ///< Where it draws by OpenGL; empty: it traces by the CPU.
};

/// A metamer-worker of this process's own, which it talks to as metamerd would: by a socket, and by
/// the memory of a picture. It is sandboxed as ever, and ends with this object. What it says is not
/// trusted.
class OwnWorker {
 public:
  /// Errors: the system's.
  static Result<OwnWorker> start(const WorkerWords& words);
  ~OwnWorker();
  OwnWorker(OwnWorker&& other) noexcept;
  OwnWorker(const OwnWorker&) = delete;

  /// A worker that is gone is found out by next().
  void send(const v1::WorkerEnvelope& message);
  /// Waits for what it says next. Errors: how it ended, "killed by signal 9 (Killed)"; what it did
  /// that no worker does; it has been silent for too long. It is ended by then.
  Result<v1::WorkerEnvelope> next();
  /// Ends it for something that it did.
  tl::unexpected<Problem> distrust(const std::string& what);

  /// Makes the picture's memory, all zero. False: the system refuses.
  bool size_film(std::size_t bytes);
  /// And fills it with what a file has, which must be as long.
  Result<void> fill_film(const std::filesystem::path& picture);
  const char* film() const { return film_bytes_; }

 private:
  OwnWorker(pid_t pid, int socket, int film) : pid_(pid), socket_(socket), film_(film) {}
  std::string end();

  pid_t pid_;
  int socket_;
  int film_;
  char* film_bytes_ = nullptr;  // of film_
  std::size_t film_size_ = 0;
};

}  // namespace metamer::batch
