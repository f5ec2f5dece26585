#include "server/service/listener.h"

#include <spdlog/spdlog.h>

#include "server/service/limits.h"

namespace metamer::service {

namespace {

/// Wait after a failed accept (no descriptors left, say), which would fail again at once.
constexpr std::chrono::milliseconds accept_pause{100};

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

void Listener::start(ServiceContext& context) {
  for (auto& acceptor : acceptors_) {
    asio::co_spawn(executor_, accept(acceptor, context), asio::detached);
  }
}

void Listener::stop() {
  stopped_ = true;
  for (auto& acceptor : acceptors_) acceptor.close();
  for (const auto& session : sessions_) session->close();
  for (const auto& session : turned_away_) session->close();
}

asio::awaitable<void> Listener::accept(wire::Acceptor& acceptor, ServiceContext& context) {
  asio::steady_timer timer(executor_);
  while (!stopped_) {
    auto [error, socket] = co_await acceptor.accept();
    if (stopped_) break;
    if (!error) {
      admit(std::move(socket), context);
      continue;
    }
    spdlog::warn("can't accept a connection: {}", error.message());
    timer.expires_after(accept_pause);
    co_await timer.async_wait(asio::as_tuple(asio::use_awaitable));
  }
}

void Listener::admit(wire::Socket socket, ServiceContext& context) {
  const bool full = sessions_.size() >= max_sessions;
  // Even those who are told so are counted: further connections are closed without a word.
  if (full && turned_away_.size() >= max_sessions) return;
  auto& list = full ? turned_away_ : sessions_;
  const auto remove = [&list](const Session& gone) {
    std::erase_if(list, [&](const auto& session) { return session.get() == &gone; });
  };
  list.push_back(std::make_shared<Session>(std::move(socket), context, remove));
  if (!full) return list.back()->start();
  list.back()->turn_away(
      {v1::Error::LIMIT,
       fmt::format("the server has its {} sessions; try again later", max_sessions)});
}

}  // namespace metamer::service
