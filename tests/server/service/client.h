#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/wire/frame.h"
#include "metamer/v1/envelope.pb.h"

namespace metamer::service::test {

/// A client with blocking calls, which can also say what no client should.
class Client {
 public:
  /// Connects to a Unix socket. Says nothing yet.
  explicit Client(const std::string& path);
  /// The same at a port of 127.0.0.1: to the server another peer than a Unix socket's.
  explicit Client(std::uint16_t port);
  ~Client();
  Client(const Client&) = delete;

  void send_bytes(const std::string& bytes);
  void send(const v1::Envelope& message);
  /// The next message; nothing when the server has closed. Fails the test after 20 s.
  std::optional<v1::Envelope> receive();
  /// The same, nothing also where none has come yet.
  std::optional<v1::Envelope> receive_if_there();
  /// Sends under a new request id and gives the answer to it; events that come before are kept for
  /// receive_event().
  v1::Envelope ask(v1::Envelope message);
  /// The next event, and the last one's fields in reach of a predicate.
  v1::JobEvent receive_event();
  v1::JobEvent receive_event_until(const std::function<bool(const v1::JobEvent&)>& wanted);
  /// Reads until the server has closed; false when a message came.
  bool closed_by_server();
  /// No more from this side; the other can still be read.
  void finish_sending();
  /// Is gone without a word, as by a pulled cable: what comes is neither taken nor acknowledged.
  void vanish();

  v1::Welcome hello(const std::string& token = {});
  /// The answer to Hello, whatever it is.
  v1::Envelope log_in(const std::string& token = {});
  v1::Info info();
  /// Sends what is missing of these, in small pieces; gives the digests, 32 bytes each.
  std::vector<std::string> upload(const std::vector<std::string>& assets);
  /// A job whose scene is this text.
  std::uint64_t submit(const std::string& scene, bool check_only = false,
                       bool keep_factors = false);
  /// Gives the request's number.
  std::uint64_t watch(std::uint64_t job, std::uint64_t from = 0, bool tiles = true,
                      bool previews = false, bool factors = false);
  v1::JobSummary summary(std::uint64_t job);
  void ping();

 private:
  std::optional<v1::Envelope> receive_within(int milliseconds);

  int fd_ = -1;
  wire::FrameDecoder decoder_;
  std::uint64_t last_request_ = 0;
  std::vector<v1::JobEvent> events_;  // that came while an answer was waited for
};

}  // namespace metamer::service::test
