#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <string>

#include "metamer/v1/worker.pb.h"

namespace metamer::worker {

/// The worker's end of the socket pair. Any thread may send; one thread receives.
class Link {
 public:
  explicit Link(int descriptor) : descriptor_(descriptor) {}

  /// False when the daemon is gone.
  bool send(const v1::WorkerEnvelope& message);

  /// The same for what comes in swarms and can wait: it goes with the next message that can't, or
  /// with the next one that comes `lateness` after the last, so that the daemon is woken once for
  /// many. What stands alone goes at once.
  bool send_with_others(const v1::WorkerEnvelope& message);
  static constexpr std::chrono::milliseconds lateness{40};

  /// The next message; nothing when the daemon is gone or has sent what is no message.
  std::optional<v1::WorkerEnvelope> receive();

 private:
  bool flush();

  int descriptor_;
  std::mutex sending_;
  std::string unsent_;  ///< Frames.
  std::chrono::steady_clock::time_point sent_{};
};

}  // namespace metamer::worker
