#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <vector>

#include "common/wire/endpoint.h"
#include "common/wire/tls.h"
#include "server/service/net/door.h"
#include "server/service/net/session.h"
#include "server/service/net/tls_greeting.h"

namespace metamer::service {

/// How the listening sockets are opened.
struct ListenOptions {
  wire::SocketFile socket;          ///< Of Unix sockets.
  wire::TlsIdentity tls;            ///< For `tls:` endpoints; empty: none can be opened.
  std::filesystem::path client_ca;  ///< Who signs clients' certificates; empty: nobody is asked.
  bool insecure = false;            ///< TCP without TLS is opened for other machines, too.
  /// After which a TCP peer is taken for gone.
  std::chrono::seconds dead_peer = wire::dead_peer_limit;
};

/// The listening sockets and the sessions of those who connected. A connection waits at the door
/// until its Hello is accepted, and then takes a place among the sessions, if there is one.
class Listener {
 public:
  explicit Listener(const asio::any_io_executor& executor)
      : executor_(executor),
        recheck_(executor),
        door_(std::make_shared<Door>(max_newcomers, max_newcomers_of_source)) {}

  /// Opens a listening socket. Errors: see wire::Acceptor::listen and wire::TlsContext; TCP without
  /// TLS that other machines could reach.
  Result<void> open(const wire::Endpoint& endpoint, const ListenOptions& options);
  /// Reads the certificates anew, for those who connect from now on. Errors: as open(); then those
  /// from before stay.
  Result<void> reload_certificates(const ListenOptions& options);
  /// Where it listens, with the ports that the kernel chose.
  std::vector<wire::Endpoint> endpoints() const;
  /// Begins to accept clients. `context` must outlive the listener.
  void start(ServiceContext& context);
  /// Closes the listening sockets and lets each session finish, which says `message` to those who
  /// watch jobs. Returns when all have, or after `limit`.
  asio::awaitable<void> drain(std::string message, std::chrono::milliseconds limit);
  /// Closes the listening sockets and ends all sessions.
  void stop();

  /// Those that are let in.
  std::uint32_t sessions() const;
  void for_each(const std::function<void(const Session&)>& call) const;

 private:
  asio::awaitable<void> accept(wire::Acceptor& acceptor, ServiceContext& context);
  asio::awaitable<void> greet(wire::Socket socket, bool tls, ServiceContext& context);
  asio::awaitable<void> end_revoked(ServiceContext& context);
  tl::expected<void, Refusal> admit(const Identity& identity, ServiceContext& context);
  bool has_room(const Identity& identity, ServiceContext& context) const;
  bool make_room(const Identity& identity, const ServiceContext& context);

  asio::any_io_executor executor_;
  asio::steady_timer recheck_;
  std::optional<wire::TlsContext> tls_;
  std::optional<TlsGreeting> tls_greeting_;
  std::list<wire::Acceptor> acceptors_;
  std::shared_ptr<Door> door_;  // outlived by the coroutines of those who wait there
  std::vector<std::shared_ptr<Session>> sessions_;  // those at the door, too
  bool stopped_ = false;
  bool draining_ = false;
};

}  // namespace metamer::service
