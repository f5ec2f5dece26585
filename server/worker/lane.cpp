#include "server/worker/lane.h"

#include <cstdio>
#include <cstdlib>

namespace metamer::worker {

Lane::Lane(const WorkerOptions& options, Link& link, Work& work, std::atomic<bool>& busy)
    : options_(options),
      link_(link),
      work_(work),
      busy_(busy),
      views_(options, link, work,
             [this] {
               const std::lock_guard lock(mutex_);
               changed_.notify_all();
             }),
      thread_([this] { run(); }) {}

Lane::~Lane() {
  {
    const std::lock_guard lock(mutex_);
    leaving_ = true;
    if (job_) job_->stop();
  }
  changed_.notify_all();
  thread_.join();
}

bool Lane::take(const v1::WorkerEnvelope& message) {
  switch (message.body_case()) {
    case v1::WorkerEnvelope::kCompileJob:
    case v1::WorkerEnvelope::kRenderTiles: {
      std::unique_lock lock(mutex_);
      // The daemon sends a step only after the one before has answered, so this is short.
      changed_.wait(lock, [this] { return !in_step_ && !waiting_; });
      if (message.has_compile_job()) {
        retired_ = std::move(job_);
        job_ = std::make_unique<Job>(message.job_id(), options_, link_, work_, views_);
      } else if (!job_ || job_->id() != message.job_id()) {
        return false;
      }
      waiting_ = message;
      changed_.notify_all();
      return true;
    }
    case v1::WorkerEnvelope::kStopJob:
      stop(message.job_id());
      return true;
    case v1::WorkerEnvelope::kOpenView:
    case v1::WorkerEnvelope::kUpdateView:
    case v1::WorkerEnvelope::kNextFrame:
    case v1::WorkerEnvelope::kCloseView:
    case v1::WorkerEnvelope::kProbe:
      return views_.take(message);
    case v1::WorkerEnvelope::kPreparing:
    case v1::WorkerEnvelope::kPrepared:
    case v1::WorkerEnvelope::kReady:
    case v1::WorkerEnvelope::kHeartbeat:
    case v1::WorkerEnvelope::kPlanned:
    case v1::WorkerEnvelope::kTileDone:
    case v1::WorkerEnvelope::kTilesVerified:
    case v1::WorkerEnvelope::kDone:
    case v1::WorkerEnvelope::kFactorsPiece:
    case v1::WorkerEnvelope::kStopped:
    case v1::WorkerEnvelope::kFailed:
    case v1::WorkerEnvelope::kViewEvent:
    case v1::WorkerEnvelope::kAssetDamaged:
    case v1::WorkerEnvelope::BODY_NOT_SET:
      return false;
  }
  return false;
}

void Lane::stop(std::uint64_t job_id) {
  const std::lock_guard lock(mutex_);
  if (!job_ || job_->id() != job_id) return;
  if (in_step_ || waiting_) {
    job_->stop();  // the step answers
  } else if (!job_->ended()) {
    job_->stop();
    job_->send_stopped();
  }
}

void Lane::run() {
  if (const auto entered = options_.backend->enter(); !entered) {
    std::fprintf(stderr, "metamer-worker: %s\n", entered.error().message.c_str());
    std::_Exit(1);
  }
  std::unique_lock lock(mutex_);
  for (;;) {
    busy_ = views_.importing();
    changed_.wait(lock, [this] { return leaving_ || waiting_ || views_.waiting(); });
    if (leaving_) return;
    busy_ = true;
    if (!waiting_) {
      lock.unlock();
      views_.serve();
      lock.lock();
      continue;
    }
    const v1::WorkerEnvelope message = std::move(*waiting_);
    waiting_.reset();
    in_step_ = true;
    auto retired = std::move(retired_);
    lock.unlock();
    retired.reset();
    step(message);
    lock.lock();
    // A stop that came after the step last looked is answered here.
    if (job_->stopped() && !job_->ended()) job_->send_stopped();
    in_step_ = false;
    changed_.notify_all();
  }
}

void Lane::step(const v1::WorkerEnvelope& message) {
  if (message.has_compile_job())
    job_->compile(message.compile_job());
  else
    job_->render(message.render_tiles());
}

}  // namespace metamer::worker
