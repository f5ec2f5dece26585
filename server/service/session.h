#pragma once

#include <boost/asio.hpp>
#include <deque>
#include <functional>
#include <memory>

#include "common/wire/channel.h"
#include "server/service/dispatch.h"
#include "server/service/watches.h"

namespace metamer::service {

/// One client's connection: reads requests, writes answers and events. What waits to be sent is
/// bounded: at max_unsent_answers answers or max_unsent_bytes no further request is read, and
/// events stay in their job's log until there is room. Whatever a client does ends its own session
/// at worst.
class Session : public std::enable_shared_from_this<Session> {
 public:
  /// `gone` is called once, when the session has ended.
  using Gone = std::function<void(const Session&)>;
  Session(wire::Socket socket, ServiceContext& context, AccountPtr account, Gone gone);

  void start();
  /// Sends one Error and ends.
  void turn_away(const Refusal& refusal);
  /// Ends at once.
  void close();

  using Clock = std::chrono::steady_clock;
  bool is_open() const { return channel_.is_open(); }
  const AccountPtr& account() const { return account_; }
  /// Since when its client has said nothing and waits for nothing, or does not read what it waits
  /// for; nothing while it does something, or has ended.
  std::optional<Clock::time_point> idle_since() const;

 private:
  asio::awaitable<void> read_requests();
  asio::awaitable<void> write_answers();
  void run(asio::awaitable<void> loop);
  void handle(v1::Envelope request);
  void limit_upload();
  void send(v1::Envelope answer);
  std::optional<v1::Envelope> next_to_send();
  std::string frames_to_send();
  void close_view(View& view);

  wire::Channel channel_;
  ServiceContext& context_;
  AccountPtr account_;
  Gone gone_;
  Watches watches_;
  ViewStreams views_;
  Dispatch dispatch_;
  std::deque<v1::Envelope> answers_;
  std::size_t unsent_bytes_ = 0;  // of answers_
  bool writing_ = false;
  Clock::time_point last_progress_ = Clock::now();
  bool views_next_ = false;      // watches and views have turns
  bool ending_ = false;          // after the answers that wait, nothing more is sent or read
  int running_ = 0;              // loops
  asio::steady_timer sendable_;  // cancelled when there may be something to send
  asio::steady_timer room_;      // cancelled when an answer has left
  asio::steady_timer timeout_;   // for the Hello, the next chunk, and the peer's closing
};

}  // namespace metamer::service
