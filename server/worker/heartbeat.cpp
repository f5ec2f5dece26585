#include "server/worker/heartbeat.h"

namespace metamer::worker {

Heartbeat::Heartbeat(Link& link, const Work& work, const std::atomic<bool>& busy)
    : link_(link), work_(work), busy_(busy), thread_([this] { run(); }) {}

Heartbeat::~Heartbeat() {
  {
    const std::lock_guard lock(mutex_);
    leaving_ = true;
  }
  leave_.notify_all();
  thread_.join();
}

void Heartbeat::run() {
  std::unique_lock lock(mutex_);
  while (!leave_.wait_for(lock, std::chrono::milliseconds(250), [this] { return leaving_; })) {
    v1::WorkerEnvelope beat;
    beat.mutable_heartbeat()->set_work(work_);
    beat.mutable_heartbeat()->set_busy(busy_);
    link_.send(beat);
  }
}

}  // namespace metamer::worker
