#pragma once

#include <boost/asio.hpp>
#include <list>
#include <memory>
#include <string>

#include "common/wire/tls.h"
#include "server/service/net/door.h"
#include "server/service/net/handshakes.h"

namespace metamer::service {

namespace asio = boost::asio;

/// What those at the door of a TLS endpoint go through before their Hello: a place among the
/// handshakes, and the handshake.
class TlsGreeting {
 public:
  using Clock = std::chrono::steady_clock;
  /// Both outlive it.
  TlsGreeting(const asio::any_io_executor& executor, const Limits& limits,
              const Patience& patience);

  /// Ends at `deadline`, or when the one who has `place` at the door has to go. Of those who wait
  /// for a handshake the newest is next: the others are more likely to be gone. Errors: as
  /// wire::accept_tls, or why it was ended here.
  asio::awaitable<wire::TlsStream> shake_hands(wire::Socket socket, wire::TlsContext tls,
                                               std::string source, Door::Place place,
                                               Clock::time_point deadline);

 private:
  using Timers = std::list<asio::steady_timer*>;
  /// What ends a connection before its time, and why it was.
  struct Ending {
    wire::Abort abort;
    const char* why = nullptr;
    void now(const char* reason);
  };
  asio::awaitable<std::shared_ptr<void>> turn(wire::Socket& socket, std::string source,
                                              std::shared_ptr<Ending> end);

  asio::any_io_executor executor_;
  // Outlived by the coroutines of those who are at it.
  std::shared_ptr<Timers> waiting_ = std::make_shared<Timers>();  // newest first
  std::shared_ptr<Handshakes> handshakes_;
};

}  // namespace metamer::service
