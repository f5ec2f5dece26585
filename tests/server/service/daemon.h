#pragma once

#include <boost/asio.hpp>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "client.h"
#include "server/service/ops/folders.h"
#include "server/service/service.h"

namespace metamer::service::test {

/// A service with the fake worker, in a thread of its own and in a temporary folder.
class Daemon {
 public:
  /// `change` may alter the options before the start.
  explicit Daemon(const std::function<void(ServiceOptions&)>& change = {});
  ~Daemon();

  const std::filesystem::path& folder() const { return folder_.path(); }
  std::string socket() const { return (folder() / "socket").string(); }
  /// A TCP port of 127.0.0.1.
  std::uint16_t port() const { return port_; }
  /// Lets a worker that waits at its gate go on, or the next one that comes there.
  void open_gate();
  /// Says how starting a worker shall fail from now on: "no-start" or "never-ready".
  void spoil_start(const std::string& how);
  void mend_start(const std::string& how);

 private:
  TemporaryFolder folder_;
  int gate_ = -1;
  boost::asio::io_context context_;
  std::unique_ptr<Service> service_;
  std::uint16_t port_ = 0;
  std::thread thread_;
};

}  // namespace metamer::service::test
