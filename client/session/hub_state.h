#pragma once

#include <boost/asio.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "client/session/connect.h"
#include "client/session/hub.h"
#include "client/session/live_view.h"
#include "client/session/restart_limit.h"

namespace metamer::client {

namespace asio = boost::asio;

/// A job that is watched, over the loss of sessions.
struct Recording {
  JobParts parts;
  std::stop_token stop;
  std::function<void(const v1::JobEvent&)> on_event;
  SessionHub::Done<JobRecord> done;
  JobRecord record;
  std::uint64_t next = 0;  ///< Event.
};

/// All but `loop` and `thread` belongs to the thread.
struct SessionHub::State : std::enable_shared_from_this<State> {
  std::unique_ptr<asio::io_context> loop =
      std::make_unique<asio::io_context>(1);  ///< Goes with the hub.
  std::optional<asio::executor_work_guard<asio::io_context::executor_type>> work =
      asio::make_work_guard(*loop);
  std::thread thread;
  std::function<void(const LinkStatus&)> on_status;

  std::string server;
  std::shared_ptr<Connection> connection;  ///< Coroutines that use its session share it.
  std::vector<std::weak_ptr<LiveView>> views;
  std::optional<asio::steady_timer> retry{*loop};
  /// Never expires: cancelled by a new session, or by none. Many may wait; one that set it anew
  /// would wake the others.
  std::optional<asio::steady_timer> changed{std::in_place, *loop,
                                            asio::steady_timer::time_point::max()};
  RestartLimit restarts;    ///< Of private servers.
  unsigned generation = 0;  ///< Of the server that was named.
  bool trying = false;      ///< keep_up() of this generation runs.
  bool ended = false;

  void say(LinkStatus status) const {
    status.server = server;
    if (on_status && !ended) on_status(status);
  }

  asio::awaitable<void> keep_up(unsigned mine);
  asio::awaitable<void> watch_over(std::shared_ptr<Connection> held);
  asio::awaitable<void> keep_recording(std::shared_ptr<Recording> recording);
  SessionError why_lost(Connection& lost) const;
  double next_try(const SessionError& why, bool was_there, unsigned failures);

  void start() {
    trying = true;
    asio::co_spawn(*loop, keep_up(generation), asio::detached);
  }

  /// Nothing of the server that was named goes on.
  void leave(const char* why) {
    ++generation;
    trying = false;
    restarts.forget();
    drop_connection(session_error(SessionError::Kind::disconnected, why).value());
    retry->cancel();
    changed->cancel();
  }

  /// The session is gone: its views, which may wait for nothing, hear of it.
  void drop_connection(const SessionError& why) {
    connection.reset();
    for (const auto& view : std::exchange(views, {}))
      if (const auto live = view.lock()) live->lose(why);
  }

  /// Runs a request with the session that there is, and gives its answer away.
  template <class T>
  void ask(std::function<asio::awaitable<Answer<T>>(Session&)> request, Done<T> done) {
    asio::post(*loop, [self = shared_from_this(), request = std::move(request),
                       done = std::move(done)]() mutable {
      if (!self->connection)
        return done(session_error(SessionError::Kind::disconnected, "there is no server"));
      auto held = self->connection;
      asio::co_spawn(*self->loop, answer<T>(std::move(held), std::move(request), std::move(done)),
                     asio::detached);
    });
  }

  template <class T>
  static asio::awaitable<void> answer(std::shared_ptr<Connection> held,
                                      std::function<asio::awaitable<Answer<T>>(Session&)> request,
                                      Done<T> done) {
    done(co_await request(*held->session));
  }
};

}  // namespace metamer::client
