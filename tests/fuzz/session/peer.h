#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "common/wire/frame.h"
#include "facts.h"
#include "metamer/v1/envelope.pb.h"

namespace metamer::fuzz {

/// A client on a socket that never blocks, which holds each answer against what was asked.
class Peer {
 public:
  /// By a Unix socket, or by TCP from 127.0.0.`host`.
  Peer(Facts& facts, const std::string& path);
  Peer(Facts& facts, std::uint16_t port, std::uint8_t host);
  ~Peer();
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  /// Sends a request under an id of its own, or under the last one once more.
  void ask(v1::Envelope request, bool same_id = false);
  /// The first bytes of its frame only; the rest comes before whatever is sent next.
  void ask_half(v1::Envelope request, std::size_t bytes);
  /// A frame of any bytes.
  void send_frame(const std::string& payload);
  /// What is no frame at all: nothing can be asked any more.
  void send_garbage(const std::string& bytes);
  void finish_half();

  /// Sends what waits, and takes at most so many bytes.
  void read(std::size_t most);
  /// How a step has told it to read.
  std::size_t appetite = everything;
  static constexpr std::size_t everything = std::size_t{1} << 30;

  void finish_sending();
  /// Without FIN.
  void reset();

  /// Closed by the server, or by itself.
  bool closed() const { return closed_; }
  bool greeted() const { return !user_.empty(); }
  bool can_ask() const { return !closed_ && !spoiled_; }
  /// The last question, after which all others have their answers.
  void ask_last();
  bool has_last() const { return last_ && ledger_.at(*last_).got > 0; }
  /// Each question had as many answers as it has to have.
  void check_answers() const;
  /// What answered the last request, in a run that asks one by one.
  const v1::Envelope& latest() const { return latest_; }

 private:
  /// What was asked under an id, and what has come.
  struct Asked {
    unsigned times = 0;
    unsigned least = 0, most = 0, got = 0;
    bool streams = false, over = false;
    std::uint64_t job = 0;       // that it names
    std::uint64_t sequence = 0;  // of the last event
  };

  void send(const std::string& bytes);
  void flush();
  void note(const v1::Envelope& request);
  void take(const v1::Envelope& message);
  void take_event(Asked& asked, const v1::JobEvent& event) const;
  void check_stranger(const Asked& asked, const v1::Envelope& message) const;
  bool is_mine(std::uint64_t job) const;
  void close();

  Facts& facts_;
  int fd_ = -1;
  bool closed_ = false, spoiled_ = false;
  std::string user_;
  bool is_admin_ = false;
  std::string unsent_;
  std::string half_;                    // what is left of a frame
  std::optional<v1::Envelope> halved_;  // its request
  wire::FrameDecoder decoder_;
  std::uint64_t last_id_ = 0;
  std::optional<std::uint64_t> last_;
  std::map<std::uint64_t, Asked> ledger_;
  v1::Envelope latest_;
};

}  // namespace metamer::fuzz
