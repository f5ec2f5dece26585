#pragma once

#include <mutex>
#include <optional>

#include "metamer/v1/worker.pb.h"

namespace metamer::worker {

/// The worker's end of the socket pair. Any thread may send; one thread receives.
class Link {
 public:
  explicit Link(int descriptor) : descriptor_(descriptor) {}

  /// False when the daemon is gone.
  bool send(const v1::WorkerEnvelope& message);

  /// The next message; nothing when the daemon is gone or has sent what is no message.
  std::optional<v1::WorkerEnvelope> receive();

 private:
  int descriptor_;
  std::mutex sending_;
};

}  // namespace metamer::worker
