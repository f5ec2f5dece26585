#include "server/service/net/tls_greeting.h"

#include <utility>

namespace metamer::service {

TlsGreeting::TlsGreeting(const asio::any_io_executor& executor, const Limits& limits,
                         const Patience& patience)
    : executor_(executor),
      handshakes_(std::make_shared<Handshakes>(limits, patience, [waiting = waiting_] {
        for (asio::steady_timer* const timer : *waiting) timer->cancel();
      })) {}

/// A place among the handshakes as long as what it gives lives; null when the connection has ended
/// meanwhile.
asio::awaitable<std::shared_ptr<void>> TlsGreeting::turn(wire::Socket& socket, std::string source,
                                                         std::shared_ptr<wire::Abort> end) {
  asio::steady_timer wake(executor_);
  const auto at = waiting_->insert(waiting_->begin(), &wake);
  const std::shared_ptr<void> waits(nullptr,
                                    [waiting = waiting_, at](void*) { waiting->erase(at); });
  *end = [&socket, &wake] {
    boost::system::error_code ignored;
    socket.close(ignored);
    wake.cancel();
  };
  // Who says nothing has begun no handshake.
  const auto [error] =
      co_await socket.async_wait(asio::socket_base::wait_read, asio::as_tuple(asio::use_awaitable));
  std::shared_ptr<void> place;
  while (socket.is_open() && !error) {
    const auto close = [end] {
      if (*end) (*end)();
    };
    const auto entered = handshakes_->enter(source, close, Clock::now());
    if (entered) {
      place.reset(static_cast<void*>(end.get()),
                  [handshakes = handshakes_, at = *entered](void*) { handshakes->leave(at); });
      break;
    }
    wake.expires_at(entered.error());
    co_await wake.async_wait(asio::as_tuple(asio::use_awaitable));
  }
  *end = {};
  co_return place;
}

asio::awaitable<wire::TlsStream> TlsGreeting::shake_hands(wire::Socket socket, wire::TlsContext tls,
                                                          std::string source, Door::Place place,
                                                          Clock::time_point deadline) {
  // Whoever ends it finds it still there: what it ends is gone only after it has left the door.
  const auto end = std::make_shared<wire::Abort>();
  place->close = [end] {
    if (*end) (*end)();
  };
  asio::steady_timer timer(executor_, deadline);
  timer.async_wait([end](boost::system::error_code cancelled) {
    if (!cancelled && *end) (*end)();
  });
  const std::shared_ptr<void> at = co_await turn(socket, std::move(source), end);
  if (!at)
    co_return tl::unexpected(
        wire::TlsError{wire::TlsError::Kind::failed, "it ended before its handshake", {}});
  co_return co_await wire::accept_tls(std::move(socket), std::move(tls), end.get());
}

}  // namespace metamer::service
