#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "server/worker/job.h"
#include "server/worker/views.h"

namespace metamer::worker {

/// The CPU lane or the GL lane: carries out the daemon's messages, one step of one job at a time,
/// and between steps and in the middle of them the views', on a thread of its own, so that StopJob
/// is heard in the middle of a step.
class Lane {
 public:
  /// `busy` says whether there is anything that it has to get on with.
  Lane(const WorkerOptions& options, Link& link, Work& work, std::atomic<bool>& busy);
  ~Lane();  ///< Stops the running step and waits for it.

  /// Takes a message from the daemon. Not blocking, but for a step that still winds up. False for
  /// a message that a worker does not expect: daemon and worker are of different builds.
  bool take(const v1::WorkerEnvelope& message);

 private:
  void run();
  void step(const v1::WorkerEnvelope& message);
  void stop(std::uint64_t job_id);

  const WorkerOptions& options_;
  Link& link_;
  Work& work_;
  std::atomic<bool>& busy_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::unique_ptr<Job> job_;      ///< Replaced between steps only.
  std::unique_ptr<Job> retired_;  ///< The one before, which ends where its GL context is.
  std::optional<v1::WorkerEnvelope> waiting_;  ///< The next step.
  bool in_step_ = false;
  bool leaving_ = false;
  Views views_;
  std::thread thread_;
};

}  // namespace metamer::worker
