#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "server/service/job.h"
#include "server/service/refusal.h"

namespace metamer::service {

/// A number for the first job of a daemon that starts at `now`: the microseconds since 1970,
/// so that numbers do not come again after a restart. They would if jobs had come faster than one a
/// microsecond, or if the clock were set back to within a few microseconds of an earlier start: as
/// many as that daemon had jobs. Modulo 2^52, which is reached in 2112; JSON's readers keep
/// integers up to 2^53.
std::uint64_t clock_job_id(std::chrono::system_clock::time_point now);

/// All jobs, and the order in which the queued ones run: their owners have turns, and each one's
/// jobs are served as they came. Ended jobs stay until their number or the bytes of their films are
/// over the bounds, oldest ended first.
class JobQueue {
 public:
  using JobPtr = std::shared_ptr<Job>;

  /// Jobs are numbered from `first_id` on.
  JobQueue(std::uint64_t keep_bytes, std::uint64_t first_id)
      : keep_bytes_(keep_bytes), next_id_(first_id) {}

  /// Queues a job. Refused (LIMIT) while max_live_jobs have not ended, or the owner's share of
  /// them.
  tl::expected<JobPtr, Refusal> submit(v1::Submit submit, AssetHolds assets, AccountPtr owner = {});
  /// Null when there is none of that number (any more).
  JobPtr find(std::uint64_t id) const;

  /// Takes the next queued job for a backend out of the line; null when there is none.
  JobPtr next(v1::Backend backend);
  /// Puts a retried job in front of all others.
  void put_first(JobPtr job);

  /// Refused: STATE, or LIMIT when the films of paused jobs would go over the bytes to keep.
  tl::expected<void, Refusal> cancel(Job& job);
  tl::expected<void, Refusal> pause(Job& job);
  tl::expected<void, Refusal> resume(const JobPtr& job);
  /// Says that `job` has ended, and drops what is too much. A dropped job that is still watched
  /// keeps its picture while those of its kind take no more than the bytes to keep either.
  void ended(Job& job);

  /// Tells whoever asks what a backend's queued jobs wait for.
  void hold(v1::Backend backend, const std::string& reason);

  bool has_work(v1::Backend backend) const;
  std::uint32_t queued() const {
    return static_cast<std::uint32_t>(retried_.size() + line_.size());
  }
  std::uint32_t running() const;
  v1::JobList list() const;

 private:
  void leave_line(const Job& job);
  void drop(std::map<std::uint64_t, JobPtr>::iterator job);
  std::uint64_t paused_bytes() const;

  std::uint64_t keep_bytes_;
  std::uint64_t next_id_;
  std::map<std::uint64_t, JobPtr> jobs_;
  std::deque<JobPtr> retried_;  // come before all others
  std::deque<JobPtr> line_;
  std::uint64_t turn_ = 0;                   // of owners, so far
  std::vector<std::weak_ptr<Job>> dropped_;  // and perhaps watched still, oldest first
  std::deque<std::uint64_t> ended_;          // oldest ended first
  std::uint64_t ended_bytes_ = 0;
};

}  // namespace metamer::service
