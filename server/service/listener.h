#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <vector>

#include "common/wire/endpoint.h"
#include "server/service/session.h"

namespace metamer::service {

/// The open doors and the sessions that came through them.
class Listener {
 public:
  explicit Listener(const asio::any_io_executor& executor) : executor_(executor) {}

  /// Opens a door. Errors: see wire::Acceptor::listen.
  Result<void> open(const wire::Endpoint& endpoint);
  /// The open doors, with the ports that the kernel chose.
  std::vector<wire::Endpoint> endpoints() const;
  /// Begins to let clients in. `house` must outlive the listener.
  void start(House& house);
  /// Closes the doors and ends all sessions.
  void stop();

  std::uint32_t sessions() const { return static_cast<std::uint32_t>(sessions_.size()); }

 private:
  asio::awaitable<void> accept(wire::Acceptor& acceptor, House& house);
  void admit(wire::Socket socket, House& house);

  asio::any_io_executor executor_;
  std::list<wire::Acceptor> acceptors_;
  std::vector<std::shared_ptr<Session>> sessions_;
  std::vector<std::shared_ptr<Session>> turned_away_;
  bool stopped_ = false;
};

}  // namespace metamer::service
