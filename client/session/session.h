#pragma once

#include <boost/asio/awaitable.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "client/session/credentials.h"
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
  /// Connects to "unix:PATH", "HOST:PORT" or "tls:HOST:PORT" and shakes hands. `credentials`: not
  /// set, those that `metamer login` has kept. A token is said by TLS or within this machine only.
  /// Errors: input (an address that is none, credentials that can't be read or would be sent where
  /// others read them), no_server (with the system's reason, because it took too long, or because
  /// it is not to be trusted), disconnected (no answer to the handshake), version, refused
  /// (UNAUTHENTICATED). Ends with an error soon when the coroutine is cancelled.
  static boost::asio::awaitable<Answer<std::unique_ptr<Session>>> connect(
      std::string server, ConnectLimits limits = {}, std::optional<Credentials> credentials = {});
  ~Session();

  const v1::Welcome& welcome() const;
  /// Why the connection is lost; nothing: it stands.
  const std::optional<std::string>& lost() const;
  /// Is called once, when it is lost; not, where it is already.
  void when_lost(std::function<void()> call);

  /// Seconds that an answer takes.
  boost::asio::awaitable<Answer<double>> ping();
  boost::asio::awaitable<Answer<v1::Info>> info();
  /// The jobs that the server shows, oldest first, in as many answers as that takes; `mine`: an
  /// admin's own alone.
  boost::asio::awaitable<Answer<v1::JobList>> list(bool mine = false);
  boost::asio::awaitable<Answer<v1::JobSummary>> cancel(std::uint64_t job_id);
  boost::asio::awaitable<Answer<v1::JobSummary>> pause(std::uint64_t job_id);
  boost::asio::awaitable<Answer<v1::JobSummary>> resume(std::uint64_t job_id);
  /// From -100 to 100: higher first, among the user's own.
  boost::asio::awaitable<Answer<v1::JobSummary>> prioritize(std::uint64_t job_id,
                                                            std::int32_t priority);

  /// Sends what the server lacks, then the job; gives its number. `submission` must outlive it.
  boost::asio::awaitable<Answer<std::uint64_t>> submit(const Submission& submission);

  /// Gives the job's events to `on_event`, in order, until its last one. An error of `on_event`
  /// ends it early and is passed on. So does `stop`, requested by any thread at any time, without
  /// an error. The server forgets a watch that ends early; one that knows no Unwatch keeps its
  /// place taken until the job ends.
  using OnEvent = std::function<Answer<void>(const v1::JobEvent&)>;
  boost::asio::awaitable<Answer<void>> watch(v1::Watch request, OnEvent on_event,
                                             std::stop_token stop = {});

 private:
  friend class View;
  struct State;
  class Exchange;
  explicit Session(std::shared_ptr<State> state);
  boost::asio::awaitable<Answer<void>> shake_hands(const std::string& token);
  boost::asio::awaitable<Answer<v1::Envelope>> ask(v1::Envelope request);
  boost::asio::awaitable<Answer<v1::JobSummary>> control(v1::Envelope request);
  boost::asio::awaitable<Answer<void>> send_missing(const std::vector<Upload>& uploads);
  boost::asio::awaitable<Answer<void>> send(const Upload& upload);
  boost::asio::awaitable<Answer<bool>> follow(Exchange& exchange, v1::Watch request,
                                              const OnEvent& on_event, std::stop_token stop);

  std::shared_ptr<State> state_;
};

}  // namespace metamer::client
