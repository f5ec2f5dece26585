#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "server/worker/job.h"

namespace metamer {

/// Tells the daemon four times a second that this process lives, and how far its work has come.
class Heartbeat {
 public:
  Heartbeat(Link& link, const Work& work);
  ~Heartbeat();

 private:
  void run();

  Link& link_;
  const Work& work_;
  std::mutex mutex_;
  std::condition_variable leave_;
  bool leaving_ = false;
  std::thread thread_;
};

}  // namespace metamer
