#include "server/service/net/listener.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "server/service/limits.h"

namespace metamer::service {

namespace {

/// Wait after a failed accept (no descriptors left, say), which would fail again at once.
constexpr std::chrono::milliseconds accept_pause{100};

}  // namespace

Result<void> Listener::reload_certificates(const ListenOptions& options) {
  auto context = wire::TlsContext::server(options.tls, options.client_ca);
  if (!context) return tl::unexpected(context.error());
  tls_ = *std::move(context);
  return {};
}

Result<void> Listener::open(const wire::Endpoint& endpoint, const ListenOptions& options) {
  if (endpoint.tls && options.tls.certificate.empty())
    return problem("can't listen on " + wire::to_string(endpoint) +
                   ": TLS needs --tls-cert and --tls-key");
  if (endpoint.tls && !tls_)
    if (auto loaded = reload_certificates(options); !loaded) return loaded;
  auto acceptor = wire::Acceptor::listen(executor_, endpoint, options.socket, options.dead_peer);
  if (!acceptor) return tl::unexpected(acceptor.error());
  if (!endpoint.tls && !acceptor->is_local() && !options.insecure)
    return problem("can't listen on " + wire::to_string(endpoint) +
                   ": other machines reach it, and what is said there, tokens too, could be read "
                   "on the way. Listen on tls:" +
                   wire::to_string(endpoint) + ", or say --insecure");
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
  tls_greeting_.emplace(executor_, context.limits, context.patience);
  for (auto& acceptor : acceptors_) {
    asio::co_spawn(executor_, accept(acceptor, context), asio::detached);
  }
  if (context.logins.keeps_users()) asio::co_spawn(executor_, end_revoked(context), asio::detached);
}

asio::awaitable<void> Listener::drain(std::string message, std::chrono::milliseconds limit) {
  constexpr std::chrono::milliseconds interval{5};
  const auto deadline = Session::Clock::now() + limit;
  draining_ = true;
  for (auto& acceptor : acceptors_) acceptor.close();
  door_->close();
  for (const auto& session : sessions_) session->finish(message);
  asio::steady_timer timer(executor_);
  while (!sessions_.empty() && !stopped_ && Session::Clock::now() < deadline) {
    timer.expires_after(interval);
    co_await timer.async_wait(asio::as_tuple(asio::use_awaitable));
  }
}

void Listener::stop() {
  stopped_ = true;
  recheck_.cancel();
  for (auto& acceptor : acceptors_) acceptor.close();
  door_->close();
  for (const auto& session : sessions_) session->close();
}

std::uint32_t Listener::sessions() const {
  return static_cast<std::uint32_t>(
      std::count_if(sessions_.begin(), sessions_.end(),
                    [](const auto& session) { return session->is_admitted(); }));
}

void Listener::for_each(const std::function<void(const Session&)>& call) const {
  for (const auto& session : sessions_)
    if (session->is_admitted()) call(*session);
}

asio::awaitable<void> Listener::accept(wire::Acceptor& acceptor, ServiceContext& context) {
  asio::steady_timer timer(executor_);
  while (!stopped_) {
    auto [error, socket] = co_await acceptor.accept();
    if (stopped_ || draining_) break;
    if (!error) {
      const auto ended = [](const std::exception_ptr& failure) {
        try {
          if (failure) std::rethrow_exception(failure);
        } catch (const std::exception& exception) {
          spdlog::error("a connection was closed: {}", exception.what());
        }
      };
      asio::co_spawn(executor_, greet(std::move(socket), acceptor.endpoint().tls, context), ended);
      continue;
    }
    spdlog::warn("can't accept a connection: {}", error.message());
    timer.expires_after(accept_pause);
    co_await timer.async_wait(asio::as_tuple(asio::use_awaitable));
  }
}

/// From the first byte until the session's own coroutines take over.
asio::awaitable<void> Listener::greet(wire::Socket socket, bool tls, ServiceContext& context) {
  const auto deadline = Session::Clock::now() + context.patience.hello;
  Visitor visitor{wire::peer_of(socket), tls, {}};
  const Door::Place place = door_->enter(visitor.source());
  std::shared_ptr<void> stay(nullptr, [door = door_, place](void*) { door->leave(place); });
  std::unique_ptr<wire::Stream> stream;
  if (tls) {
    auto shaken = co_await tls_greeting_->shake_hands(std::move(socket), *tls_, visitor.source(),
                                                      place, deadline);
    if (stopped_ || draining_) co_return;
    if (!shaken) {
      context.logins.failed(visitor, shaken.error().message);
      co_return;
    }
    stream = *std::move(shaken);
    if (const auto* shown = stream->certificate()) visitor.certificate_names = shown->names;
  } else {
    stream = wire::plain_stream(std::move(socket));
  }

  // Its place at the door is given up with its admission, or its end.
  const auto at_door = std::make_shared<std::shared_ptr<void>>(std::move(stay));
  Session::Handlers handlers;
  handlers.admit = [this, at_door, &context](const Identity& identity) {
    auto admitted = admit(identity, context);
    if (admitted) at_door->reset();
    return admitted;
  };
  handlers.gone = [this, at_door](const Session& gone) {
    at_door->reset();
    std::erase_if(sessions_, [&](const auto& session) { return session.get() == &gone; });
  };
  const auto session = std::make_shared<Session>(std::move(stream), std::move(visitor), context,
                                                 std::move(handlers));
  place->close = [known = std::weak_ptr(session)] {
    if (const auto open = known.lock()) open->close();
  };
  sessions_.push_back(session);
  session->start(deadline);
}

/// Whether a further session leaves enough for others.
bool Listener::has_room(const Identity& identity, ServiceContext& context) const {
  PlaceWanted wanted{.listed = identity.listed, .admin = identity.is_admin()};
  for_each([&](const Session& session) {
    ++wanted.open;
    wanted.own += session.identity().user == identity.user;
  });
  wanted.max_own = context.accounts.named(identity.user)->max_sessions;
  return may_enter(wanted, context.limits.sessions, reserved_sessions);
}

/// Ends the session that was idle for longest: one of the same user, or with a full table of any.
bool Listener::make_room(const Identity& identity, const ServiceContext& context) {
  const bool full = sessions() >= context.limits.sessions;
  auto oldest = Session::Clock::now() - context.patience.idle_session;
  std::shared_ptr<Session> idle;
  for (const auto& session : sessions_) {
    if (!session->is_admitted()) continue;
    const auto since = session->idle_since();
    if (!since || *since > oldest || (!full && session->identity().user != identity.user)) continue;
    oldest = *since;
    idle = session;
  }
  if (!idle) return false;
  log_line(spdlog::level::info, {.peer = idle->visitor().source(), .user = idle->identity().user},
           "an idle session makes room");
  idle->close();
  return true;
}

tl::expected<void, Refusal> Listener::admit(const Identity& identity, ServiceContext& context) {
  if (has_room(identity, context) || make_room(identity, context)) return {};
  return refuse(v1::Error::LIMIT,
                fmt::format("{} has its share of the server's {} sessions; try again later",
                            identity.user, context.limits.sessions));
}

/// Whoever was revoked while he was in goes within seconds.
asio::awaitable<void> Listener::end_revoked(ServiceContext& context) {
  while (!stopped_) {
    recheck_.expires_after(context.patience.recheck);
    const auto [cancelled] = co_await recheck_.async_wait(asio::as_tuple(asio::use_awaitable));
    if (cancelled || stopped_) co_return;
    try {
      std::map<std::tuple<std::string, std::string, Identity::Known, v1::Role>, bool> known;
      for (const auto& session : sessions_) {
        if (!session->is_admitted()) continue;
        const Identity& identity = session->identity();
        const auto [entry, is_new] =
            known.try_emplace({identity.user, identity.token_hash, identity.known, identity.role});
        if (is_new) entry->second = context.logins.stands(identity);
        if (entry->second) continue;
        session->end({v1::Error::UNAUTHENTICATED, "what you came in with is no longer valid"});
      }
    } catch (const DatabaseError& error) {
      spdlog::error("the table of users can't be read: {}", error.what());
    }
  }
}

}  // namespace metamer::service
