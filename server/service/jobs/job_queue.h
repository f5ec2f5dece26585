#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/service/jobs/job.h"
#include "server/service/jobs/job_counts.h"
#include "server/service/limits.h"
#include "server/service/refusal.h"
#include "server/service/schedule/admission.h"
#include "server/service/schedule/fair_share.h"
#include "server/service/schedule/retention.h"
#include "server/service/schedule/work_ledger.h"
#include "server/service/wall_clock.h"

namespace metamer::service {

/// A number for the first job of a daemon that starts at `now`: the microseconds since 1970,
/// so that numbers do not come again after a restart. They would if jobs had come faster than one a
/// microsecond, or if the clock were set back to within a few microseconds of an earlier start: as
/// many as that daemon had jobs. Modulo 2^52, which is reached in 2112; JSON's readers keep
/// integers up to 2^53.
std::uint64_t clock_job_id(std::chrono::system_clock::time_point now);

/// All jobs, and the order in which the queued ones run: each backend's worker is shared by their
/// owners (FairShare), and each one's jobs go by priority, then by number. Ended jobs stay until
/// their number or the bytes of their films are over the bounds, of which each user has its share
/// (Retention), or they are too old.
class JobQueue {
 public:
  using JobPtr = std::shared_ptr<Job>;

  /// Jobs are numbered from `first_id` on. `limits` outlives the queue.
  JobQueue(std::uint64_t keep_bytes, std::uint64_t first_id, const Limits& limits = default_limits,
           WallClock clock = wall_clock)
      : keep_bytes_(keep_bytes), limits_(limits), clock_(std::move(clock)), next_id_(first_id) {}

  const Limits& limits() const { return limits_; }

  /// Keeps all jobs from now on, and goes on with the numbers of those that were kept.
  void keep_in(JobStore& store, std::string build);
  /// Takes over a job that was kept: one that has ended, or that Job::go_on() has queued or left
  /// paused.
  void restore(JobPtr job);
  /// And, once all are there, what their users have had.
  void restore(const std::vector<KeptLead>& leads, const std::vector<KeptWork>& work);
  /// Keeps what could not be kept before.
  void keep_again();
  /// The server ends: jobs that run are queued, for the next one to go on with.
  void set_aside();

  /// Queues a job, or finds the one that the same request has made before. Refused (LIMIT) while
  /// as many as may have not ended, or the owner's share of them.
  tl::expected<JobPtr, Refusal> submit(v1::Submit submit, AssetHolds assets, AccountPtr owner = {});
  /// Null when there is none of that number (any more).
  JobPtr find(std::uint64_t id) const;

  /// Takes the next queued job for a backend out of the line, and begins its turn; null when there
  /// is none.
  JobPtr next(v1::Backend backend);
  /// Puts a job whose worker was lost, or which has yielded, back to its place in the line.
  void put_back(JobPtr job);
  /// A worker has spent so many seconds on a job that it was given.
  void spend(Job& job, double seconds);
  /// Whether another job is next rather than this one, which runs. Where it is not, the running
  /// one's next turn begins.
  bool gives_way(const Job& running);
  /// What a job waits for whose user has had all that it may of the workers today; empty: nothing.
  std::string work_text(const Job& job) const;
  /// Whether a job may start beside the others, by the memory that it takes.
  Admission admission(const Job& job) const { return admission(job, memory_taken()); }
  /// What views take is taken from jobs.
  void count_views(std::function<std::uint64_t()> memory) { views_memory_ = std::move(memory); }
  /// Why a view of that size can't be open, `own` of what is taken being its own; nothing: it can.
  std::optional<std::string> refuse_view(const JobSize& size, std::uint64_t own) const;

  /// Refused: STATE, or LIMIT when the films of paused jobs would go over the bytes to keep.
  tl::expected<void, Refusal> cancel(Job& job);
  tl::expected<void, Refusal> pause(Job& job);
  tl::expected<void, Refusal> resume(const JobPtr& job);
  /// Refused: STATE for a job that has ended, LIMIT for a priority out of range.
  tl::expected<void, Refusal> prioritize(Job& job, std::int32_t priority);
  /// Says that `job` has ended, and drops what is too much. A dropped job that is still watched
  /// keeps its picture while those of its kind take no more than the bytes to keep either.
  void ended(Job& job);
  /// Drops the ended jobs whose time is over; to be called now and then.
  void drop_old();
  /// The disk is full: gives back the picture of one job that is no longer listed and is watched
  /// still. False: there is none.
  bool drop_unlisted_picture();

  /// Tells whoever asks what a backend's queued jobs wait for.
  void hold(v1::Backend backend, const std::string& reason);

  bool has_work(v1::Backend backend) const;
  std::uint32_t queued() const { return static_cast<std::uint32_t>(line_.size()); }
  std::uint32_t running() const;
  void for_each(const std::function<void(const Job&)>& call) const;
  /// Of all jobs that are listed; with an owner, of its jobs.
  std::uint64_t picture_bytes(const AccountPtr& owner = {}) const;
  /// Seconds that workers spent on each user's jobs within a day.
  std::map<std::string, double> day_seconds() const;
  /// How many they may spend on this one's within a day; 0: as many as it wants.
  double most_day_seconds(const Account& account) const;
  /// Since the start; who draws a tile counts it here.
  JobCounts& counts() { return counts_; }
  /// Those with numbers above `after` that may be seen, as many as a control message holds.
  /// With what it waits for.
  v1::JobSummary summary(const Job& job) const;
  v1::JobList list(std::uint64_t after, const std::function<bool(const Job&)>& seen) const;

 private:
  void leave_line(const Job& job);
  std::string turn_text(const Job& job) const;
  std::string obstacle(const Job& job, std::uint64_t taken) const;
  std::uint64_t memory_taken() const;
  Admission admission(const Job& job, std::uint64_t taken) const;
  void note_presence(const Job& job);
  void list_ended(Job& job);
  void drop(std::uint64_t id);
  void keep_usage(v1::Backend backend);
  std::uint64_t paused_bytes() const;

  JobPtr find_same(const v1::Submit& submit, const AccountPtr& owner) const;
  std::int32_t series_priority(const v1::Submit& submit, const AccountPtr& owner) const;
  void add(const JobPtr& job);

  std::uint64_t keep_bytes_;
  const Limits& limits_;
  WallClock clock_;
  std::uint64_t next_id_;
  JobStore* store_ = nullptr;
  std::string build_;
  /// The user and the client's key of a job.
  using Key = std::pair<std::string, std::string>;
  std::map<Key, std::uint64_t> keys_;
  std::map<std::uint64_t, JobPtr> jobs_;
  std::map<std::uint64_t, JobPtr> live_;  // of them, those that have not ended
  std::vector<JobPtr> line_;
  std::map<v1::Backend, FairShare> shares_;       // of each backend's worker
  std::map<v1::Backend, double> unkept_seconds_;  // that the store has not been told of
  std::vector<std::weak_ptr<Job>> dropped_;       // and perhaps watched still, oldest first
  WorkLedger work_;
  Retention ended_;
  std::function<std::uint64_t()> views_memory_ = [] { return 0; };
  JobCounts counts_;
};

}  // namespace metamer::service
