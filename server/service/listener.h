#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <vector>

#include "common/wire/endpoint.h"
#include "server/service/session.h"

namespace metamer::service {

/// The listening sockets and the sessions of those who connected.
class Listener {
 public:
  explicit Listener(const asio::any_io_executor& executor) : executor_(executor) {}

  /// Opens a listening socket. Errors: see wire::Acceptor::listen.
  Result<void> open(const wire::Endpoint& endpoint);
  /// Where it listens, with the ports that the kernel chose.
  std::vector<wire::Endpoint> endpoints() const;
  /// Begins to accept clients. `context` must outlive the listener.
  void start(ServiceContext& context);
  /// Closes the listening sockets and ends all sessions.
  void stop();

  std::uint32_t sessions() const { return static_cast<std::uint32_t>(sessions_.size()); }

 private:
  asio::awaitable<void> accept(wire::Acceptor& acceptor, ServiceContext& context);
  void admit(wire::Socket socket, ServiceContext& context);
  bool has_room(const AccountPtr& account) const;
  bool make_room(const AccountPtr& account, std::chrono::milliseconds patience);

  asio::any_io_executor executor_;
  std::list<wire::Acceptor> acceptors_;
  std::vector<std::shared_ptr<Session>> sessions_;
  std::vector<std::shared_ptr<Session>> turned_away_;
  bool stopped_ = false;
};

}  // namespace metamer::service
