#include "server/service/listener.h"

#include <spdlog/spdlog.h>

#include "server/service/limits.h"

namespace metamer::service {

namespace {

/// After a failed accept (no descriptors left, say) the door rests, lest it spins.
constexpr std::chrono::milliseconds rest{100};

}  // namespace

Result<void> Listener::open(const wire::Endpoint& endpoint) {
  auto acceptor = wire::Acceptor::listen(executor_, endpoint);
  if (!acceptor) return tl::unexpected(acceptor.error());
  spdlog::info("listening on {}", wire::to_string(acceptor->endpoint()));
  acceptors_.push_back(*std::move(acceptor));
  return {};
}

std::vector<wire::Endpoint> Listener::endpoints() const {
  std::vector<wire::Endpoint> endpoints;
  for (const auto& acceptor : acceptors_) endpoints.push_back(acceptor.endpoint());
  return endpoints;
}

void Listener::start(House& house) {
  for (auto& acceptor : acceptors_) {
    asio::co_spawn(executor_, accept(acceptor, house), asio::detached);
  }
}

void Listener::stop() {
  stopped_ = true;
  for (auto& acceptor : acceptors_) acceptor.close();
  for (const auto& session : sessions_) session->close();
  for (const auto& session : turned_away_) session->close();
}

asio::awaitable<void> Listener::accept(wire::Acceptor& acceptor, House& house) {
  asio::steady_timer timer(executor_);
  while (!stopped_) {
    auto [error, socket] = co_await acceptor.accept();
    if (stopped_) break;
    if (!error) {
      admit(std::move(socket), house);
      continue;
    }
    spdlog::warn("can't accept a connection: {}", error.message());
    timer.expires_after(rest);
    co_await timer.async_wait(asio::as_tuple(asio::use_awaitable));
  }
}

void Listener::admit(wire::Socket socket, House& house) {
  const bool full = sessions_.size() >= max_sessions;
  // Even those who are told so are counted: the next ones find a closed door.
  if (full && turned_away_.size() >= max_sessions) return;
  auto& list = full ? turned_away_ : sessions_;
  const auto remove = [&list](const Session& gone) {
    std::erase_if(list, [&](const auto& session) { return session.get() == &gone; });
  };
  list.push_back(std::make_shared<Session>(std::move(socket), house, remove));
  if (!full) return list.back()->start();
  list.back()->turn_away(
      {v1::Error::LIMIT,
       fmt::format("the server has its {} sessions; try again later", max_sessions)});
}

}  // namespace metamer::service
