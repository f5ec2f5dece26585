#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "common/problem.h"
#include "metamer/v1/worker.pb.h"
#include "server/film/film.h"
#include "server/worker/link.h"

namespace metamer::worker {

/// What one job says to the daemon. From any thread.
class JobMessages {
 public:
  JobMessages(std::uint64_t id, Link& link) : id_(id), link_(link) {}

  std::uint64_t id() const { return id_; }
  /// True once JobDone, Failed or JobStopped has been sent, and until the next begin().
  bool ended() const { return ended_; }
  void begin() { ended_ = false; }

  // On the way.
  void preparing(v1::Preparing::Stage stage);
  void prepared(const v1::Timing& timing);
  void planned(const v1::Plan& plan);
  void tile(const Rect& rect, std::uint64_t rays);
  void tiles_verified(std::uint32_t tiles);
  /// In pieces that a worker's frame holds; of a tile, or of the scene. False for more than is
  /// kept, or for none at all: then nothing is sent.
  bool factors(const Rect* rect, const std::string& bytes);

  // The last.
  void done(v1::JobDone done);
  void stopped(v1::RunRecord record);
  void failed(v1::Failed::Kind kind, const std::string& reason);
  void failed(const std::vector<Problem>& problems);

 private:
  v1::WorkerEnvelope envelope() const;
  void send_last(const v1::WorkerEnvelope& message);

  std::uint64_t id_;
  Link& link_;
  std::atomic<bool> ended_ = false;
};

}  // namespace metamer::worker
