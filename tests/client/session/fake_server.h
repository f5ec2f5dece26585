#pragma once

#include <boost/asio.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "client/session/session.h"
#include "common/wire/channel.h"
#include "common/wire/endpoint.h"

namespace metamer::test {

using namespace client;

/// A server that does what a test says: each request goes to `answer`, which gives what to send
/// back, in order, each with the request's number filled in where it has none. An answer without a
/// body closes.
class FakeServer {
 public:
  using AnswerTo = std::function<std::vector<v1::Envelope>(const v1::Envelope& request)>;

  explicit FakeServer(AnswerTo answer);
  ~FakeServer();

  /// Connects to it, does `work`, and runs until both are done.
  using Work = std::function<boost::asio::awaitable<void>(Session&)>;
  /// The error of connect(), where it had one; `cancel` cancels that.
  std::optional<SessionError> run(Work work, ConnectLimits limits = {},
                                  boost::asio::cancellation_slot cancel = {});

  /// Serves one connection after another on a thread of its own while `work` runs here; `answer` is
  /// then called on that thread.
  void beside(const std::function<void(const std::string& server)>& work);

 private:
  boost::asio::awaitable<void> serve();
  boost::asio::awaitable<void> serve_all();

  AnswerTo answer_;
  std::string folder_;
  boost::asio::io_context loop_{1};
  std::optional<wire::Acceptor> acceptor_;
};

/// A Welcome with ordinary limits.
v1::Envelope welcome(std::uint32_t version = 1);
v1::Envelope error(v1::Error::Code code, const std::string& message);
/// A job's progress, and its end.
v1::Envelope event(std::uint64_t sequence);
v1::Envelope last_event(std::uint64_t sequence);

}  // namespace metamer::test
