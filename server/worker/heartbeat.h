#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "server/worker/job.h"

namespace metamer::worker {

/// Tells the daemon four times a second that this process lives, whether it has work, and how far
/// that has come.
class Heartbeat {
 public:
  Heartbeat(Link& link, const Work& work, const std::atomic<bool>& busy);
  ~Heartbeat();

 private:
  void run();

  Link& link_;
  const Work& work_;
  const std::atomic<bool>& busy_;
  std::mutex mutex_;
  std::condition_variable leave_;
  bool leaving_ = false;
  std::thread thread_;
};

}  // namespace metamer::worker
