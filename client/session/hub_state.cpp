#include "client/session/hub_state.h"

#include "client/session/record_job.h"

namespace metamer::client {
namespace {

/// How soon a lost server is noticed where nobody asks anything.
constexpr std::chrono::seconds beat{2};
/// A person waits for it, before a window that goes on.
constexpr ConnectLimits link_limits{.connection = std::chrono::seconds(5)};
/// The window comes before what it has rendered on the same machine.
constexpr int private_nice = 5;

}  // namespace

double retry_delay(unsigned failures) {
  return failures >= 5 ? 30 : static_cast<double>(1u << failures);
}

/// Connects, and again where that fails or what stood is lost, until another server is named.
asio::awaitable<void> SessionHub::State::keep_up(unsigned mine) {
  const auto self = shared_from_this();
  unsigned failures = 0;
  while (mine == generation && !ended) {
    say({.kind = LinkStatus::Kind::connecting, .server = {}});
    Answer<Connection> made =
        co_await connect(server, link_limits, server.empty() ? private_nice : 0);
    if (mine != generation || ended) co_return;
    const bool was_there = made.has_value();
    SessionError why;
    if (made) {
      failures = 0;
      connection = std::make_shared<Connection>(std::move(*made));
      changed->cancel();
      say({.kind = LinkStatus::Kind::ready,
           .server = {},
           .welcome = connection->session->welcome()});
      co_await watch_over(connection);
      if (mine != generation || ended) co_return;
      why = why_lost(*connection);
      drop_connection(why);
    } else {
      why = made.error();
    }
    const double delay = next_try(why, was_there, failures++);
    trying = delay >= 0;
    say({.kind = LinkStatus::Kind::lost, .server = {}, .error = why, .retry_in = delay});
    if (!trying) co_return;
    boost::system::error_code cancelled;
    retry->expires_after(std::chrono::milliseconds(static_cast<int>(1000 * delay)));
    co_await retry->async_wait(asio::redirect_error(asio::use_awaitable, cancelled));
  }
}

/// Seconds until the server is tried again; below 0: it is not.
double SessionHub::State::next_try(const SessionError& why, bool was_there, unsigned failures) {
  if (why.kind == SessionError::Kind::version || why.kind == SessionError::Kind::input) return -1;
  if (server.empty() && !restarts.take(RestartLimit::Clock::now())) return -1;
  return server.empty() && was_there ? 0 : retry_delay(failures);
}

SessionError SessionHub::State::why_lost(Connection& lost) const {
  SessionError why;
  if (lost.own) why.message = lost.own->how_it_ended();
  if (why.message.empty())
    why.message = lost.session->lost().value_or("lost the connection to the server");
  return why;
}

/// Returns when the session is lost. Asks it now and then how fast it answers.
asio::awaitable<void> SessionHub::State::watch_over(std::shared_ptr<Connection> held) {
  const auto self = shared_from_this();
  const auto timer = std::make_shared<asio::steady_timer>(*loop);
  held->session->when_lost([timer] { timer->cancel(); });
  const auto say_slow = [this, held](double seconds) {
    say({.kind = LinkStatus::Kind::ready,
         .server = {},
         .slow = seconds,
         .welcome = held->session->welcome()});
  };
  const auto slow = std::make_shared<bool>(false);  // the handler may come after this has ended
  while (connection == held && !ended && !held->session->lost()) {
    asio::steady_timer due(*loop, std::chrono::milliseconds(static_cast<int>(1000 * slow_answer)));
    due.async_wait([slow, say_slow](const boost::system::error_code& cancelled) {
      if (!cancelled && !std::exchange(*slow, true)) say_slow(slow_answer);
    });
    const Answer<double> answered = co_await held->session->ping();
    due.cancel();
    if (!answered) co_return;
    const double seconds = *answered < slow_answer ? 0 : *answered;
    if (*slow || seconds > 0) say_slow(seconds);
    *slow = seconds > 0;
    timer->expires_after(beat);
    boost::system::error_code ignored;
    co_await timer->async_wait(asio::redirect_error(asio::use_awaitable, ignored));
  }
}

/// Over all sessions with the server that it began with.
asio::awaitable<void> SessionHub::State::keep_recording(std::shared_ptr<Recording> recording) {
  const auto self = shared_from_this();
  const unsigned mine = generation;
  const std::stop_callback stopped(recording->stop, [weak = weak_from_this()] {
    const auto state = weak.lock();
    if (state && state->loop) asio::post(*state->loop, [state] { state->changed->cancel(); });
  });
  while (true) {
    const auto held = connection;
    Answer<void> ended = co_await record_on(*held->session, recording->record, recording->next,
                                            recording->parts, recording->on_event, recording->stop);
    if (ended) co_return recording->done(std::move(recording->record));
    // A server that was started anew knows nothing of the jobs before.
    if (recording->next > 0 && ended.error().code == v1::Error::NOT_FOUND)
      ended.error().message = "the job ended with the server that had it";
    if (!held->session->lost()) co_return recording->done(tl::unexpected(ended.error()));
    while ((!connection || connection == held) && mine == generation) {
      if (recording->stop.stop_requested()) co_return recording->done(std::move(recording->record));
      boost::system::error_code ignored;
      co_await changed->async_wait(asio::redirect_error(asio::use_awaitable, ignored));
    }
    if (mine != generation) co_return recording->done(tl::unexpected(ended.error()));
  }
}

}  // namespace metamer::client
