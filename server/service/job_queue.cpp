#include "server/service/job_queue.h"

#include <algorithm>
#include <cassert>

#include "server/service/limits.h"

namespace metamer::service {

namespace {

tl::unexpected<Refusal> wrong_state(const Job& job, const char* request) {
  return refuse(v1::Error::STATE, "job " + std::to_string(job.id()) + " is " + word(job.state()) +
                                      " and can't be " + request);
}

}  // namespace

std::uint64_t clock_job_id(std::chrono::system_clock::time_point now) {
  using std::chrono::microseconds;
  const auto since_1970 = std::chrono::duration_cast<microseconds>(now.time_since_epoch());
  return static_cast<std::uint64_t>(since_1970.count()) % (std::uint64_t{1} << 52) + 1;
}

tl::expected<JobQueue::JobPtr, Refusal> JobQueue::submit(v1::Submit submit, AssetHolds assets,
                                                         AccountPtr owner) {
  const std::size_t live = jobs_.size() - ended_.size();
  if (live >= max_live_jobs) {
    return refuse(v1::Error::LIMIT,
                  "the queue is full: " + std::to_string(max_live_jobs) + " jobs have not ended");
  }
  const auto own = std::count_if(jobs_.begin(), jobs_.end(), [&](const auto& job) {
    return !job.second->ended() && job.second->owner() == owner;
  });
  if (owner && !may_take(static_cast<std::uint64_t>(own), 1, max_live_jobs - live)) {
    return refuse(v1::Error::LIMIT, owner->name + " has its share of the queue: " +
                                        std::to_string(own) + " of its jobs have not ended");
  }
  auto job = std::make_shared<Job>(next_id_++, std::move(submit), std::move(assets),
                                   queued() + running(), std::move(owner));
  jobs_.emplace(job->id(), job);
  line_.push_back(job);
  return job;
}

JobQueue::JobPtr JobQueue::find(std::uint64_t id) const {
  const auto found = jobs_.find(id);
  return found == jobs_.end() ? nullptr : found->second;
}

JobQueue::JobPtr JobQueue::next(v1::Backend backend) {
  const auto fits = [&](const JobPtr& job) { return job->submit().backend() == backend; };
  const auto last_turn = [](const JobPtr& job) {
    return job->owner() ? job->owner()->last_turn : 0;
  };
  if (const auto found = std::find_if(retried_.begin(), retried_.end(), fits);
      found != retried_.end()) {
    JobPtr job = *found;
    retried_.erase(found);
    return job;
  }
  // The one whose owner has waited for longest; of one owner the first.
  auto best = line_.end();
  for (auto it = line_.begin(); it != line_.end(); ++it)
    if (fits(*it) && (best == line_.end() || last_turn(*it) < last_turn(*best))) best = it;
  if (best == line_.end()) return nullptr;
  JobPtr job = *best;
  line_.erase(best);
  if (job->owner()) job->owner()->last_turn = ++turn_;
  return job;
}

bool JobQueue::has_work(v1::Backend backend) const {
  const auto fits = [&](const JobPtr& job) { return job->submit().backend() == backend; };
  return std::any_of(retried_.begin(), retried_.end(), fits) ||
         std::any_of(line_.begin(), line_.end(), fits);
}

void JobQueue::hold(v1::Backend backend, const std::string& reason) {
  for (const auto* line : {&retried_, &line_})
    for (const JobPtr& job : *line)
      if (job->submit().backend() == backend) job->hold(reason);
}

void JobQueue::put_first(JobPtr job) {
  assert(job->state() == v1::QUEUED);
  retried_.push_front(std::move(job));
}

void JobQueue::leave_line(const Job& job) {
  for (auto* line : {&retried_, &line_})
    std::erase_if(*line, [&](const JobPtr& queued) { return queued.get() == &job; });
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
  return {};
}

tl::expected<void, Refusal> JobQueue::resume(const JobPtr& job) {
  if (!job->resume(queued() + running())) return wrong_state(*job, "resumed");
  line_.push_back(job);
  return {};
}

void JobQueue::ended(Job& job) {
  assert(job.ended());
  ended_.push_back(job.id());
  ended_bytes_ += job.picture_bytes();
  // The job that has just ended stays, however large: somebody is about to fetch it.
  while (ended_.size() > 1 && (ended_.size() > max_ended_jobs || ended_bytes_ > keep_bytes_)) {
    const auto oldest = jobs_.find(ended_.front());
    ended_bytes_ -= oldest->second->picture_bytes();
    drop(oldest);
    ended_.pop_front();
  }
}

void JobQueue::drop(std::map<std::uint64_t, JobPtr>::iterator job) {
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

std::uint64_t JobQueue::paused_bytes() const {
  std::uint64_t bytes = 0;
  for (const auto& [id, job] : jobs_) {
    if (job->state() == v1::PAUSED) bytes += job->picture_bytes();
  }
  return bytes;
}

std::uint32_t JobQueue::running() const {
  return static_cast<std::uint32_t>(std::count_if(jobs_.begin(), jobs_.end(), [](const auto& job) {
    return job.second->state() == v1::RUNNING;
  }));
}

v1::JobList JobQueue::list() const {
  v1::JobList list;
  for (const auto& [id, job] : jobs_) *list.add_job() = job->summary();
  return list;
}

}  // namespace metamer::service
