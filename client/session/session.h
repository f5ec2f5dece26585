#pragma once

#include <boost/asio/awaitable.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "client/session/error.h"
#include "client/session/submission.h"
#include "metamer/v1/envelope.pb.h"

namespace metamer::client {

/// How long to wait for a server.
struct ConnectLimits {
  std::chrono::steady_clock::duration connection = std::chrono::seconds(10);
  /// A server may wait 5 s for its first worker before it says Welcome; on a loaded machine twice
  /// that.
  std::chrono::steady_clock::duration welcome = std::chrono::seconds(15);
};

/// A connection to a server after its handshake. All its coroutines run on the executor that
/// connect() ran on, which one thread drives; several may be under way at once: a job can be
/// cancelled while it is watched. Once the connection is lost every call says so. A
/// session outlives its coroutines.
class Session {
 public:
  /// Connects to "unix:PATH" or "HOST:PORT" and shakes hands.
  /// Errors: input (an address that is none), no_server (with the system's reason, or because
  /// it took too long), disconnected (no answer to the handshake), version. Ends with an error
  /// soon when the coroutine is cancelled.
  static boost::asio::awaitable<Answer<std::unique_ptr<Session>>> connect(
      std::string server, ConnectLimits limits = {});
  ~Session();

  const v1::Welcome& welcome() const;

  /// Seconds that an answer takes.
  boost::asio::awaitable<Answer<double>> ping();
  boost::asio::awaitable<Answer<v1::Info>> info();
  boost::asio::awaitable<Answer<v1::JobList>> list();
  boost::asio::awaitable<Answer<v1::JobSummary>> cancel(std::uint64_t job_id);
  boost::asio::awaitable<Answer<v1::JobSummary>> pause(std::uint64_t job_id);
  boost::asio::awaitable<Answer<v1::JobSummary>> resume(std::uint64_t job_id);

  /// Sends what the server lacks, then the job; gives its number. `submission` must outlive it.
  boost::asio::awaitable<Answer<std::uint64_t>> submit(const Submission& submission);

  /// Gives the job's events to `on_event`, in order, until its last one. An error of `on_event`
  /// ends it early and is passed on.
  using OnEvent = std::function<Answer<void>(const v1::JobEvent&)>;
  boost::asio::awaitable<Answer<void>> watch(v1::Watch request, OnEvent on_event);

 private:
  friend class View;
  struct State;
  class Exchange;
  explicit Session(std::shared_ptr<State> state);
  boost::asio::awaitable<Answer<void>> shake_hands();
  boost::asio::awaitable<Answer<v1::Envelope>> ask(v1::Envelope request);
  boost::asio::awaitable<Answer<v1::JobSummary>> control(v1::Envelope request);
  boost::asio::awaitable<Answer<void>> send_missing(const std::vector<Upload>& uploads);
  boost::asio::awaitable<Answer<void>> send(const Upload& upload);

  std::shared_ptr<State> state_;
};

}  // namespace metamer::client
