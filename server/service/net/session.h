#pragma once

#include <boost/asio.hpp>
#include <deque>
#include <functional>
#include <memory>

#include "common/wire/channel.h"
#include "server/service/net/dispatch.h"
#include "server/service/net/watches.h"
#include "server/service/ops/log.h"

namespace metamer::service {

/// One client's connection: reads requests, writes answers and events. What waits to be sent is
/// bounded: at max_unsent_answers answers or max_unsent_bytes no further request is read, and
/// events stay in their job's log until there is room. Whatever a client does ends its own session
/// at worst. Before its Hello is accepted it may send small frames only, for ten seconds.
class Session : public std::enable_shared_from_this<Session> {
 public:
  using Clock = std::chrono::steady_clock;
  struct Handlers {
    /// Gives a place among the sessions to one who is known now. Refused: LIMIT.
    std::function<tl::expected<void, Refusal>(const Identity&)> admit;
    /// Is called once, when the session has ended.
    std::function<void(const Session&)> gone;
  };
  Session(std::unique_ptr<wire::Stream> stream, Visitor visitor, ServiceContext& context,
          Handlers handlers);

  /// Begins; Hello has to come before `deadline`.
  void start(Clock::time_point deadline);
  /// Sends one Error, which answers no request, and ends.
  void end(const Refusal& refusal);
  /// The server ends: watches are told `message` after what has happened until now, and when all
  /// is sent and answered the connection closes.
  void finish(const std::string& message);
  /// Ends at once.
  void close();

  bool is_open() const { return channel_.is_open(); }
  /// Let in, and not on its way out: it has a place among the sessions.
  bool is_admitted() const { return dispatch_.greeted() && is_open() && !ending_; }
  // Once admitted.
  const Identity& identity() const { return dispatch_.identity(); }
  const AccountPtr& account() const { return dispatch_.account(); }
  const std::string& client() const { return dispatch_.client(); }

  const Visitor& visitor() const { return visitor_; }
  Clock::time_point begun() const { return begun_; }
  Clock::time_point last_progress() const { return last_progress_; }
  std::size_t watches() const { return watches_.size(); }
  std::size_t views() const { return views_.size(); }
  /// Since when its client has said nothing and waits for nothing, or does not read what it waits
  /// for; nothing while it does something, or has ended.
  std::optional<Clock::time_point> idle_since() const;

 private:
  asio::awaitable<void> read_requests();
  asio::awaitable<void> write_answers();
  void run(asio::awaitable<void> loop);
  tl::expected<Identity, Refusal> admit(const std::string& token);
  bool ends_session(const v1::Error& error) const;
  asio::awaitable<void> handle(v1::Envelope request);
  void limit_upload();
  void close_soon();
  void send(v1::Envelope answer);
  std::optional<v1::Envelope> next_to_send();
  std::string frames_to_send();
  void finish_if_done();
  void close_view(View& view);
  LogFields fields(std::string reason = {}) const;

  wire::Channel channel_;
  Visitor visitor_;
  ServiceContext& context_;
  Handlers handlers_;
  Watches watches_;
  ViewStreams views_;
  Dispatch dispatch_;
  std::deque<v1::Envelope> answers_;
  std::size_t unsent_bytes_ = 0;  // of answers_
  bool writing_ = false;
  Clock::time_point begun_ = Clock::now();
  Clock::time_point last_progress_ = begun_;
  bool views_next_ = false;      // watches and views have turns
  bool ending_ = false;          // after the answers that wait, nothing more is sent or read
  bool finishing_ = false;       // ends once there is nothing to send or to answer
  bool reads_ = true;            // or its client's last request has been answered
  int running_ = 0;              // loops
  asio::steady_timer sendable_;  // cancelled when there may be something to send
  asio::steady_timer room_;      // cancelled when an answer has left
  asio::steady_timer timeout_;   // for the Hello, the next chunk, and the peer's closing
};

}  // namespace metamer::service
