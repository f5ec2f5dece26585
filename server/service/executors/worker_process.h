#pragma once

#include <sys/types.h>

#include <boost/asio.hpp>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "common/problem.h"
#include "common/wire/channel.h"
#include "metamer/v1/worker.pb.h"

namespace metamer::service {

namespace asio = boost::asio;

/// How a worker is started.
struct WorkerCommand {
  std::filesystem::path program;
  std::filesystem::path store;
  std::uint32_t threads = 0;  ///< 0: as many as the machine has.
  v1::Backend backend = v1::CPU;
  int niceness = 0;                ///< As nice(2) has it.
  std::string gl_device = "auto";  ///< Of a GL worker: auto, reference or a number.
  std::filesystem::path group;     ///< The control group that it enters; empty: its parent's.
  std::string isa = "native";      ///< Or "avx2", "avx512": as the worker's --isa.
  bool unconfined = false;         ///< It may run where the kernel can't confine it.
};

/// One running metamer-worker: its process, its socket (descriptor 3 there) and the memory that it
/// renders into (descriptor 4). It decides nothing; see Supervisor.
class WorkerProcess : public std::enable_shared_from_this<WorkerProcess> {
 public:
  struct Handlers {
    /// What it throws ends the process.
    std::function<void(v1::WorkerEnvelope)> message;
    /// Once, last: the process is gone, and why: "killed by signal 9 (Killed)".
    std::function<void(std::string reason)> exit;
  };

  struct SpawnError {
    std::string message;    ///< "can't start PATH: No such file or directory"
    bool shortage = false;  ///< Of descriptors, processes or memory: it may pass.
  };
  /// Starts the process.
  static tl::expected<std::shared_ptr<WorkerProcess>, SpawnError> spawn(
      const asio::any_io_executor& executor, const WorkerCommand& command, Handlers handlers);
  ~WorkerProcess();

  pid_t pid() const { return pid_; }
  void send(v1::WorkerEnvelope message);

  /// Gives the worker `bytes` of shared memory, all zero, and maps them here. False when the system
  /// refuses.
  bool size_film(std::uint64_t bytes);
  /// Gives the memory's pages back to the system.
  void release_film();
  /// The bytes of size_film(), until release_film(). The worker may write there at any time, but
  /// can't make them fewer (F_SEAL_SHRINK), which would end the daemon with SIGBUS.
  const char* film() const { return static_cast<const char*>(mapped_); }
  /// Copies into it. False when the system refuses.
  bool write_film(std::uint64_t offset, const void* from, std::size_t bytes);

  /// It is gone since the system refused it memory, as it says by its exit code, or was killed
  /// where `kernel` has ended something for want of memory; and not for what it was killed for
  /// here.
  bool ran_out_of_memory(bool kernel) const;

  /// Ends the process at once. Its exit is reported with `reason` instead of what the system says.
  void kill(std::string reason);
  /// Ends the process, waits until it is gone and reports nothing any more.
  void abandon();

 private:
  WorkerProcess(pid_t pid, asio::posix::stream_descriptor exit, int film, wire::Socket socket,
                Handlers handlers);
  void run();
  asio::awaitable<void> read_messages();
  asio::awaitable<void> hear_messages();
  asio::awaitable<void> write_messages();
  asio::awaitable<void> await_exit();
  void report_if_over();
  void unmap_film();

  pid_t pid_;
  int film_;
  void* mapped_ = nullptr;  // of film_
  std::size_t mapped_bytes_ = 0;
  asio::posix::stream_descriptor exit_;  // a pidfd: readable once the process has ended
  wire::Channel channel_;
  Handlers handlers_;
  std::deque<v1::WorkerEnvelope> unsent_;
  asio::steady_timer unsent_signal_;
  asio::steady_timer grace_;
  std::string kill_reason_;
  std::optional<int> status_;  // as waitpid gives it
  bool reading_ = true;
};

}  // namespace metamer::service
