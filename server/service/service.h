#pragma once

#include <boost/asio.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/problem.h"
#include "server/service/access/logins.h"
#include "server/service/access/users.h"
#include "server/service/executors/slurm/slurm_executor.h"
#include "server/service/executors/supervisor.h"
#include "server/service/net/dispatch.h"
#include "server/service/net/listener.h"
#include "server/service/ops/metrics.h"
#include "server/service/wall_clock.h"

namespace metamer::service {

struct ServiceOptions {
  std::vector<wire::Endpoint> listen;
  ListenOptions listening;
  bool open = false;            ///< By TCP without TLS anybody may come who reaches it.
  std::filesystem::path state;  ///< What outlives the daemon; empty: nothing does.
  std::filesystem::path store;  ///< Of assets; empty: the state's.
  std::uint64_t store_bytes = 8ull << 30;
  std::uint64_t keep_bytes = 1ull << 30;  ///< Of films of ended jobs, and of paused ones.
  std::uint64_t first_job_id = clock_job_id(std::chrono::system_clock::now());
  Limits limits;
  Patience patience;
  WallClock clock = wall_clock;
  Supervisor::Options worker;      ///< Of all lanes; its store and lane are filled in.
  std::string executor = "local";  ///< Who has the CPU's jobs: "local" or "slurm".
  /// Its store, worker and names are filled in. GL jobs are Slurm's where its commands have a gres.
  SlurmExecutor::Options slurm;
};

/// The whole daemon, on one thread: everything here and below runs in `context` and nowhere else,
/// so nothing needs a lock.
class Service {
 public:
  Service(asio::io_context& context, ServiceOptions options);

  /// Opens the store and the listening sockets, and starts the worker. Errors: a store that can't
  /// be used, an endpoint in use.
  Result<void> start();
  /// Takes no more jobs and no more clients, tells those who watch, and returns when all that can
  /// be said is said, or after `limit`; then stop() is due. A running job goes on meanwhile.
  asio::awaitable<void> drain(std::chrono::milliseconds limit);
  /// Closes everything; `context` then runs out of work.
  void stop();
  /// Has other limits from now on.
  void change_limits(const Limits& limits, const Patience& patience);
  /// Of all that happens here.
  Counts counts();
  /// For people who look after it: "1 running, 3 queued, 2 sessions".
  std::string state_line() const;
  /// Reads the certificates of its TLS endpoints anew. Errors: those from before stay in use.
  Result<void> reload_certificates();
  /// Where it listens, once started.
  std::vector<wire::Endpoint> endpoints() const { return listener_.endpoints(); }

 private:
  Result<void> open_users();
  void restore_jobs();
  asio::awaitable<void> look_after_jobs();
  Executor& cpu();
  Executor& gl();

  asio::io_context& context_;
  ServiceOptions options_;
  std::unique_ptr<JobStore> state_;
  std::string build_;                       // of the worker's program
  std::optional<Database> users_database_;  // none: no users are kept
  std::optional<Users> users_;
  std::optional<Logins> logins_;
  asio::steady_timer next_look_;
  std::shared_ptr<AssetStore> store_;
  JobQueue queue_;
  Views views_;
  Supervisor cpu_, cpu_views_, gl_;
  std::optional<SlurmExecutor> slurm_, gl_slurm_;  // in the place of cpu_, and of gl_ for jobs
  std::unique_ptr<ServiceContext> service_context_;
  Listener listener_;
};

}  // namespace metamer::service
