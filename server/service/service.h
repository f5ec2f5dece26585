#pragma once

#include <boost/asio.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "common/problem.h"
#include "server/service/dispatch.h"
#include "server/service/listener.h"

namespace metamer::service {

struct ServiceOptions {
  std::vector<wire::Endpoint> listen;
  std::filesystem::path store;
  std::uint64_t store_bytes = 8ull << 30;
  std::uint64_t keep_bytes = 1ull << 30;  ///< Of films of ended jobs, and of paused ones.
  std::uint64_t first_job_id = clock_job_id(std::chrono::system_clock::now());
  Patience patience;
  Supervisor::Options worker;  ///< Of both backends; its store and backend are filled in.
};

/// The whole daemon, on one thread: everything here and below runs in `context` and nowhere else,
/// so nothing needs a lock.
class Service {
 public:
  Service(asio::io_context& context, ServiceOptions options);

  /// Opens the store and the listening sockets, and starts the worker. Errors: a store that can't
  /// be used, an endpoint in use.
  Result<void> start();
  /// Closes everything; `context` then runs out of work.
  void stop();
  /// Where it listens, once started.
  std::vector<wire::Endpoint> endpoints() const { return listener_.endpoints(); }

 private:
  asio::io_context& context_;
  ServiceOptions options_;
  std::shared_ptr<AssetStore> store_;
  JobQueue queue_;
  Views views_;
  Supervisor cpu_, gl_;
  std::unique_ptr<ServiceContext> service_context_;
  Listener listener_;
};

}  // namespace metamer::service
