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

tl::expected<JobQueue::JobPtr, Refusal> JobQueue::submit(v1::Submit submit, AssetHolds assets) {
  if (jobs_.size() - ended_.size() >= max_live_jobs) {
    return refuse(v1::Error::LIMIT,
                  "the queue is full: " + std::to_string(max_live_jobs) + " jobs have not ended");
  }
  auto job =
      std::make_shared<Job>(next_id_++, std::move(submit), std::move(assets), queued() + running());
  jobs_.emplace(job->id(), job);
  line_.push_back(job);
  return job;
}

JobQueue::JobPtr JobQueue::find(std::uint64_t id) const {
  const auto found = jobs_.find(id);
  return found == jobs_.end() ? nullptr : found->second;
}

JobQueue::JobPtr JobQueue::next(v1::Backend backend) {
  const auto found = std::find_if(line_.begin(), line_.end(), [&](const JobPtr& job) {
    return job->submit().backend() == backend;
  });
  if (found == line_.end()) return nullptr;
  JobPtr job = *found;
  line_.erase(found);
  return job;
}

bool JobQueue::has_work(v1::Backend backend) const {
  return std::any_of(line_.begin(), line_.end(),
                     [&](const JobPtr& job) { return job->submit().backend() == backend; });
}

void JobQueue::hold(v1::Backend backend, const std::string& reason) {
  for (const JobPtr& job : line_)
    if (job->submit().backend() == backend) job->hold(reason);
}

void JobQueue::put_first(JobPtr job) {
  assert(job->state() == v1::QUEUED);
  line_.push_front(std::move(job));
}

void JobQueue::leave_line(const Job& job) {
  std::erase_if(line_, [&](const JobPtr& queued) { return queued.get() == &job; });
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
    jobs_.erase(oldest);
    ended_.pop_front();
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
