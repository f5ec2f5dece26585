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
      try {
        admit(std::move(socket), context);
      } catch (const std::exception& exception) {
        spdlog::error("a connection was closed: {}", exception.what());
      }
      continue;
    }
    spdlog::warn("can't accept a connection: {}", error.message());
    timer.expires_after(accept_pause);
    co_await timer.async_wait(asio::as_tuple(asio::use_awaitable));
  }
}

/// Whether a further session leaves enough for others.
bool Listener::has_room(const AccountPtr& account) const {
  std::size_t open = 0;
  std::size_t own = 0;
  for (const auto& session : sessions_) {
    open += session->is_open();
    own += session->is_open() && session->account() == account;
  }
  return open < max_sessions && may_take(own, 1, max_sessions - open);
}

/// Ends the session that was idle for longest: one of the same peer, or with a full table of any.
bool Listener::make_room(const AccountPtr& account, std::chrono::milliseconds patience) {
  const bool full = sessions_.size() >= max_sessions;
  auto oldest = Session::Clock::now() - patience;
  std::shared_ptr<Session> idle;
  for (const auto& session : sessions_) {
    const auto since = session->idle_since();
    if (!since || *since > oldest || (!full && session->account() != account)) continue;
    oldest = *since;
    idle = session;
  }
  if (!idle) return false;
  spdlog::info("an idle session of {} makes room", idle->account()->name);
  idle->close();
  return true;
}

void Listener::admit(wire::Socket socket, ServiceContext& context) {
  const AccountPtr account = context.accounts.of(wire::peer_of(socket));
  const bool welcome = has_room(account) || make_room(account, context.patience.idle_session);
  // Even those who are told so are counted: further connections are closed without a word.
  if (!welcome && turned_away_.size() >= max_sessions) return;
  auto& list = welcome ? sessions_ : turned_away_;
  const auto remove = [&list](const Session& gone) {
    std::erase_if(list, [&](const auto& session) { return session.get() == &gone; });
  };
  list.push_back(std::make_shared<Session>(std::move(socket), context, account, remove));
  if (welcome) return list.back()->start();
  list.back()->turn_away(
      {v1::Error::LIMIT,
       fmt::format("{} has its share of the server's {} sessions; try again later", account->name,
                   max_sessions)});
}

}  // namespace metamer::service
