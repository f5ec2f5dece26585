#pragma once

#include <boost/asio.hpp>
#include <boost/asio/experimental/channel.hpp>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "client/session/session.h"
#include "common/wire/channel.h"

/// What session.cpp and view.cpp share: the connection, and the requests under way.
namespace metamer::client {

namespace asio = boost::asio;
using boost::system::error_code;

/// Answers that wait for the coroutine that asked. A full one holds the reader back, and so in
/// the end the server: memory stays bounded however slow we are.
using Inbox = asio::experimental::channel<void(error_code, v1::Envelope)>;

/// The server's refusal as an error of ours.
tl::unexpected<SessionError> refused(const v1::Error& error);
tl::unexpected<SessionError> unexpected_answer();

struct Session::State {
  State(std::unique_ptr<wire::Stream> stream, std::string named)
      : channel(std::move(stream), wire::Peer::server),
        server(std::move(named)),
        write_turn(channel.executor(), 1) {}

  /// Ends every exchange, under way or to come, with this reason.
  void lose(const std::string& reason) {
    if (lost) return;
    lost = "lost the connection to " + server + ": " + reason;
    channel.close();
    for (auto& [id, inbox] : inboxes) inbox->close();
    if (const auto call = std::exchange(on_lost, {})) call();
  }
  tl::unexpected<SessionError> why_lost() const {
    return session_error(SessionError::Kind::disconnected, lost.value_or("the session is closed"));
  }

  static asio::awaitable<void> read_all(std::shared_ptr<State> state);
  asio::awaitable<void> write(const v1::Envelope& envelope);

  wire::Channel channel;
  std::string server;
  v1::Welcome welcome;
  std::map<std::uint64_t, std::shared_ptr<Inbox>> inboxes;
  std::uint64_t last_id = 0;
  std::optional<std::string> lost;
  std::function<void()> on_lost;
  /// Holds a token while somebody writes: the channel takes one writer at a time.
  asio::experimental::channel<void(error_code)> write_turn;
};

/// One question and its answers: a request's number, and the inbox for it while this lives.
class Session::Exchange {
 public:
  explicit Exchange(std::shared_ptr<State> state);
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;
  ~Exchange();

  std::uint64_t id() const { return id_; }
  bool has_answer() const { return inbox_->ready(); }
  /// Ends receive(), under way or to come, with an error. From any thread.
  void close() {
    asio::post(state_->channel.executor(), [inbox = inbox_] { inbox->close(); });
  }

  /// The next answer; an Error is turned into one of ours.
  asio::awaitable<Answer<v1::Envelope>> receive();

  /// The number of a further request, whose answers come here too until it is forgotten.
  std::uint64_t add_request();
  void forget_request(std::uint64_t id) { state_->inboxes.erase(id); }
  /// The next answer to any of them, an Error as it came.
  asio::awaitable<Answer<v1::Envelope>> receive_any();

 private:
  std::shared_ptr<State> state_;
  std::uint64_t id_;
  std::shared_ptr<Inbox> inbox_;
};

}  // namespace metamer::client
