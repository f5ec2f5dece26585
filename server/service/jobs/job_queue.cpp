#include "server/service/jobs/job_queue.h"

#include <algorithm>
#include <cassert>

#include "server/service/limits.h"

namespace metamer::service {

namespace {

tl::unexpected<Refusal> wrong_state(const Job& job, const char* request) {
  return refuse(v1::Error::STATE, "job " + std::to_string(job.id()) + " is " + word(job.state()) +
                                      " and can't be " + request);
}

std::pair<std::string, std::string> key_of(const Job& job) {
  return {job.owner() ? job.owner()->name : "", job.submit().client_key()};
}

/// But for a priority that was given later.
bool is_same(const v1::Submit& before, v1::Submit submit) {
  submit.set_priority(before.priority());
  return submit.SerializeAsString() == before.SerializeAsString();
}

tl::expected<void, Refusal> check_priority(std::int32_t priority) {
  if (-max_priority <= priority && priority <= max_priority) return {};
  return refuse(v1::Error::LIMIT, "a priority of " + std::to_string(priority) + " is beyond -" +
                                      std::to_string(max_priority) + " to " +
                                      std::to_string(max_priority));
}

}  // namespace

std::uint64_t clock_job_id(std::chrono::system_clock::time_point now) {
  using std::chrono::microseconds;
  const auto since_1970 = std::chrono::duration_cast<microseconds>(now.time_since_epoch());
  return static_cast<std::uint64_t>(since_1970.count()) % (std::uint64_t{1} << 52) + 1;
}

tl::expected<JobQueue::JobPtr, Refusal> JobQueue::submit(v1::Submit submit, AssetHolds assets,
                                                         AccountPtr owner) {
  if (const JobPtr before = find_same(submit, owner)) {
    if (is_same(before->submit(), submit)) return before;
    return refuse(v1::Error::STATE, "job " + std::to_string(before->id()) +
                                        " was submitted with this key, and was another");
  }
  const std::size_t live = live_.size();
  if (live >= limits_.live_jobs) {
    return refuse(v1::Error::LIMIT, "the queue is full: " + std::to_string(limits_.live_jobs) +
                                        " jobs have not ended");
  }
  const auto own = std::count_if(jobs_.begin(), jobs_.end(), [&](const auto& job) {
    return !job.second->ended() && job.second->owner() == owner;
  });
  if (owner && !may_take(static_cast<std::uint64_t>(own), 1, limits_.live_jobs - live)) {
    return refuse(v1::Error::LIMIT, owner->name + " has its share of the queue: " +
                                        std::to_string(own) + " of its jobs have not ended");
  }
  if (owner && owner->max_jobs && own >= *owner->max_jobs) {
    return refuse(v1::Error::LIMIT, owner->name + " may have " + std::to_string(*owner->max_jobs) +
                                        " jobs that have not ended");
  }
  if (auto in_range = check_priority(submit.priority()); !in_range)
    return tl::unexpected(in_range.error());
  if (submit.has_series() && submit.priority() == 0)
    submit.set_priority(series_priority(submit, owner));
  ++counts_.submitted;
  auto job = std::make_shared<Job>(next_id_++, std::move(submit), std::move(assets),
                                   queued() + running(), std::move(owner));
  add(job);
  line_.push_back(job);
  note_presence(*job);
  if (store_) {
    job->set_build(build_);
    job->keep_in(*store_);
  }
  return job;
}

/// That of the newest job of the same series that has not ended: who ranked a series meant those of
/// its jobs, too, that were still to come.
std::int32_t JobQueue::series_priority(const v1::Submit& submit, const AccountPtr& owner) const {
  for (auto job = live_.rbegin(); job != live_.rend(); ++job)
    if (job->second->owner() == owner &&
        job->second->submit().series().id() == submit.series().id())
      return job->second->submit().priority();
  return 0;
}

void JobQueue::add(const JobPtr& job) {
  jobs_.emplace(job->id(), job);
  if (!job->ended()) live_.emplace(job->id(), job);
  if (!job->submit().client_key().empty()) keys_.emplace(key_of(*job), job->id());
}

JobQueue::JobPtr JobQueue::find_same(const v1::Submit& submit, const AccountPtr& owner) const {
  if (submit.client_key().empty()) return nullptr;
  const auto found = keys_.find({owner ? owner->name : "", submit.client_key()});
  return found == keys_.end() ? nullptr : find(found->second);
}

void JobQueue::keep_in(JobStore& store, std::string build) {
  store_ = &store;
  build_ = std::move(build);
  next_id_ = store.next_id();
}

void JobQueue::restore(JobPtr job) {
  add(job);
  if (job->ended()) return list_ended(*job);
  if (job->state() != v1::QUEUED) return;
  line_.push_back(job);
  note_presence(*job);
}

void JobQueue::restore(const std::vector<KeptLead>& leads, const std::vector<KeptWork>& work) {
  std::map<v1::Backend, std::vector<FairShare::Lead>> kept;
  for (const KeptLead& lead : leads) kept[lead.backend].push_back({lead.user, lead.seconds});
  for (const auto& [backend, users] : kept) shares_[backend].restore(users);
  std::vector<WorkLedger::Entry> entries;
  for (const KeptWork& one : work) entries.push_back({one.user, one.hour, one.seconds});
  work_.restore(entries);
}

void JobQueue::keep_again() {
  for (const auto& [id, job] : jobs_) job->keep_again();
}

void JobQueue::set_aside() {
  if (!store_) return;
  for (const auto& [id, job] : jobs_) job->set_aside();
  for (const auto& [backend, share] : shares_) keep_usage(backend);
}

JobQueue::JobPtr JobQueue::find(std::uint64_t id) const {
  const auto found = jobs_.find(id);
  return found == jobs_.end() ? nullptr : found->second;
}

tl::expected<void, Refusal> JobQueue::cancel(Job& job) {
  if (!job.cancel()) return wrong_state(job, "cancelled");
  leave_line(job);
  ended(job);
  return {};
}

tl::expected<void, Refusal> JobQueue::pause(Job& job) {
  if (next_state(job.state(), Step::pause) && paused_bytes() + job.picture_bytes() > keep_bytes_) {
    return refuse(v1::Error::LIMIT, "the pictures of paused jobs would take over " +
                                        std::to_string(keep_bytes_) + " bytes");
  }
  if (!job.pause()) return wrong_state(job, "paused");
  leave_line(job);
  note_presence(job);
  return {};
}

tl::expected<void, Refusal> JobQueue::resume(const JobPtr& job) {
  if (!job->resume(queued() + running())) return wrong_state(*job, "resumed");
  line_.push_back(job);
  note_presence(*job);
  return {};
}

tl::expected<void, Refusal> JobQueue::prioritize(Job& job, std::int32_t priority) {
  if (auto in_range = check_priority(priority); !in_range) return in_range;
  if (job.ended()) return wrong_state(job, "given a priority");
  job.prioritize(priority);
  return {};
}

void JobQueue::ended(Job& job) {
  assert(job.ended());
  counts_.finished += job.state() == v1::FINISHED;
  counts_.failed += job.state() == v1::FAILED;
  counts_.cancelled += job.state() == v1::CANCELLED;
  keep_usage(job.submit().backend());
  list_ended(job);
}

void JobQueue::list_ended(Job& job) {
  live_.erase(job.id());
  note_presence(job);
  ended_.add(job.user(), job.share(), {job.id(), job.picture_bytes(), job.ended_at()});
  // The job that has just ended stays, however large: somebody is about to fetch it.
  using Measure = Retention::Measure;
  while (const auto first = ended_.take_beyond(Measure::jobs, limits_.ended_jobs, job.id()))
    drop(*first);
  while (const auto first = ended_.take_beyond(Measure::bytes, keep_bytes_, job.id())) drop(*first);
}

void JobQueue::drop_old() {
  constexpr double day_seconds = 86400;
  if (limits_.keep_days == 0) return;
  const double first = clock_() - static_cast<double>(limits_.keep_days) * day_seconds;
  while (const auto old = ended_.take_before(first)) drop(*old);
}

void JobQueue::for_each(const std::function<void(const Job&)>& call) const {
  for (const auto& [id, job] : jobs_) call(*job);
}

std::uint64_t JobQueue::picture_bytes(const AccountPtr& owner) const {
  std::uint64_t bytes = 0;
  for (const auto& [id, job] : jobs_)
    if (!owner || job->owner() == owner) bytes += job->picture_bytes();
  return bytes;
}

void JobQueue::drop(std::uint64_t id) {
  const auto job = jobs_.find(id);
  if (store_) {
    if (job->second.use_count() > 1) job->second->hold_picture();
    store_->remove(job->first);
  }
  keys_.erase(key_of(*job->second));
  dropped_.push_back(job->second);
  jobs_.erase(job);
  std::erase_if(dropped_, [](const auto& known) { return known.expired(); });
  std::uint64_t bytes = 0;
  for (const auto& known : dropped_)
    if (const JobPtr watched = known.lock()) bytes += watched->picture_bytes();
  for (auto oldest = dropped_.begin(); bytes > keep_bytes_; ++oldest) {
    const JobPtr watched = oldest->lock();
    if (!watched) continue;
    bytes -= watched->picture_bytes();
    watched->drop_picture();
  }
}

bool JobQueue::drop_unlisted_picture() {
  for (const auto& known : dropped_) {
    const JobPtr watched = known.lock();
    if (!watched || watched->picture_bytes() == 0) continue;
    watched->drop_picture();
    return true;
  }
  return false;
}

std::uint64_t JobQueue::paused_bytes() const {
  std::uint64_t bytes = 0;
  for (const auto& [id, job] : jobs_) {
    if (job->state() == v1::PAUSED) bytes += job->picture_bytes();
  }
  return bytes;
}

std::uint32_t JobQueue::running() const {
  return static_cast<std::uint32_t>(std::count_if(live_.begin(), live_.end(), [](const auto& job) {
    return job.second->state() == v1::RUNNING;
  }));
}

v1::JobSummary JobQueue::summary(const Job& job) const {
  v1::JobSummary summary = job.summary();
  if (job.state() == v1::QUEUED && summary.reason().empty()) summary.set_reason(turn_text(job));
  return summary;
}

v1::JobList JobQueue::list(std::uint64_t after, const std::function<bool(const Job&)>& seen) const {
  v1::JobList list;
  std::size_t bytes = 0;
  for (auto job = jobs_.upper_bound(after); job != jobs_.end(); ++job) {
    if (!seen(*job->second)) continue;
    if (bytes > max_list_bytes) {
      list.set_more(true);
      break;
    }
    *list.add_job() = summary(*job->second);
    bytes += list.job().rbegin()->ByteSizeLong() + 4;
  }
  return list;
}

}  // namespace metamer::service
