#include "server/worker/heartbeat.h"

namespace metamer {

Heartbeat::Heartbeat(Link& link, const Work& work)
    : link_(link), work_(work), thread_([this] { run(); }) {}

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
    link_.send(beat);
  }
}

}  // namespace metamer
