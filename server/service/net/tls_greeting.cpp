#include "server/service/net/tls_greeting.h"

#include <utility>

namespace metamer::service {

void TlsGreeting::Ending::now(const char* reason) {
  if (!abort) return;
  why = reason;
  abort();
}

TlsGreeting::TlsGreeting(const asio::any_io_executor& executor, const Limits& limits,
                         const Patience& patience)
    : executor_(executor),
      handshakes_(std::make_shared<Handshakes>(limits, patience, [waiting = waiting_] {
        for (asio::steady_timer* const timer : *waiting) timer->cancel();
      })) {}

/// A place among the handshakes as long as what it gives lives; null when the connection has ended
/// meanwhile.
asio::awaitable<std::shared_ptr<void>> TlsGreeting::turn(wire::Socket& socket, std::string source,
                                                         std::shared_ptr<Ending> end) {
  asio::steady_timer wake(executor_);
  const auto at = waiting_->insert(waiting_->begin(), &wake);
  const std::shared_ptr<void> waits(nullptr,
                                    [waiting = waiting_, at](void*) { waiting->erase(at); });
  end->abort = [&socket, &wake] {
    boost::system::error_code ignored;
    socket.close(ignored);
    wake.cancel();
  };
  // Who says nothing has begun no handshake.
  const auto [error] =
      co_await socket.async_wait(asio::socket_base::wait_read, asio::as_tuple(asio::use_awaitable));
  std::shared_ptr<void> place;
  while (socket.is_open() && !error) {
    const auto close = [end] { end->now("its handshake took long, and others waited"); };
    const auto entered = handshakes_->enter(source, close, Clock::now());
    if (entered) {
      place.reset(static_cast<void*>(end.get()),
                  [handshakes = handshakes_, at = *entered](void*) { handshakes->leave(at); });
      break;
    }
    wake.expires_at(entered.error());
    co_await wake.async_wait(asio::as_tuple(asio::use_awaitable));
  }
  end->abort = {};
  co_return place;
}

asio::awaitable<wire::TlsStream> TlsGreeting::shake_hands(wire::Socket socket, wire::TlsContext tls,
                                                          std::string source, Door::Place place,
                                                          Clock::time_point deadline) {
  // Whoever ends it finds it still there: what it ends is gone only after it has left the door.
  const auto end = std::make_shared<Ending>();
  place->close = [end] { end->now("it made room for others who came"); };
  asio::steady_timer timer(executor_, deadline);
  timer.async_wait([end](boost::system::error_code cancelled) {
    if (!cancelled) end->now("its handshake was not over in time");
  });
  const std::shared_ptr<void> at = co_await turn(socket, std::move(source), end);
  if (!at) {
    const char* const why = end->why ? end->why : "it ended before its handshake";
    co_return tl::unexpected(wire::TlsError{wire::TlsError::Kind::failed, why, {}});
  }
  auto shaken = co_await wire::accept_tls(std::move(socket), std::move(tls), &end->abort);
  // Of what was ended here the connection says no more than that.
  if (!shaken && end->why) shaken.error().message = end->why;
  co_return shaken;
}

}  // namespace metamer::service
