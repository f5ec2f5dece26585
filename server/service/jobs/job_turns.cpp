// Whose turn it is: the line of queued jobs, shares and memory.
#include <algorithm>
#include <cassert>
#include <set>

#include "server/service/jobs/job_queue.h"

namespace metamer::service {

namespace {

Claim claim_of(const Job& job) { return {job.user(), job.submit().priority(), job.id()}; }

/// That it takes now, of the daemon and of a worker that has it.
std::uint64_t memory_of(const Job& job) {
  return job.state() == v1::RUNNING ? memory_estimate(job.size()) : job.film_bytes();
}

bool is_for(const Job& job, v1::Backend backend) { return job.submit().backend() == backend; }

}  // namespace

JobQueue::JobPtr JobQueue::next(v1::Backend backend) {
  const std::uint64_t taken = memory_taken();
  const std::uint32_t ahead = queued() + running();
  std::vector<Claim> waiting;
  for (const JobPtr& job : line_) {
    if (!is_for(*job, backend)) continue;
    Admission may = admission(*job, taken);
    const bool waits = may.verdict == Admission::Verdict::waits;
    job->hold(waits ? std::move(may.reason) : std::string(), ahead);
    if (!waits) waiting.push_back(claim_of(*job));
  }
  const auto chosen = shares_[backend].choose(waiting);
  if (!chosen) return nullptr;
  JobPtr job = find(waiting[*chosen].order);
  std::erase(line_, job);
  shares_[backend].begin(job->user(), job->share());
  keep_leads(backend);
  return job;
}

bool JobQueue::gives_way(const Job& running) {
  const v1::Backend backend = running.submit().backend();
  const std::uint64_t taken = memory_taken() - memory_of(running);
  std::vector<Claim> rivals{claim_of(running)};
  for (const JobPtr& job : line_)
    if (is_for(*job, backend) && admission(*job, taken).verdict != Admission::Verdict::waits)
      rivals.push_back(claim_of(*job));
  if (shares_[backend].choose(rivals) != std::size_t{0}) return true;
  shares_[backend].begin(running.user(), running.share());
  return false;
}

/// By all jobs that have not ended.
std::uint64_t JobQueue::memory_taken() const {
  std::uint64_t sum = 0;
  for (const auto& [id, job] : live_) sum += memory_of(*job);
  return sum;
}

/// `taken`: by all, with this one.
Admission JobQueue::admission(const Job& job, std::uint64_t taken) const {
  return admit(memory_estimate(job.size()), taken - memory_of(job), limits_.memory);
}

void JobQueue::spend(Job& job, double seconds) {
  job.spend(seconds);
  counts_.worker_seconds[job.submit().backend()] += seconds;
  shares_[job.submit().backend()].charge(job.user(), job.share(), seconds);
  double& unkept = unkept_seconds_[job.submit().backend()];
  unkept += seconds;
  if (unkept >= most_unkept_seconds) keep_leads(job.submit().backend());
}

/// What was spent is kept as a turn begins and ends, and now and then within a long one.
void JobQueue::keep_leads(v1::Backend backend) {
  if (!store_ || std::exchange(unkept_seconds_[backend], 0) == 0) return;
  std::vector<KeptLead> leads;
  for (FairShare::Lead& lead : shares_[backend].leads())
    leads.push_back({backend, std::move(lead.user), lead.seconds});
  store_->put_leads(backend, std::move(leads));
}

/// Tells the shares whether the job's user still has any that waits or runs.
void JobQueue::note_presence(const Job& job) {
  const v1::Backend backend = job.submit().backend();
  const bool present = std::any_of(live_.begin(), live_.end(), [&](const auto& known) {
    const Job& other = *known.second;
    return (other.state() == v1::QUEUED || other.state() == v1::RUNNING) &&
           is_for(other, backend) && other.user() == job.user();
  });
  shares_[backend].set_present(job.user(), present);
}

bool JobQueue::has_work(v1::Backend backend) const {
  return std::any_of(line_.begin(), line_.end(),
                     [&](const JobPtr& job) { return is_for(*job, backend); });
}

void JobQueue::hold(v1::Backend backend, const std::string& reason) {
  const std::uint32_t ahead = queued() + running();
  for (const JobPtr& job : line_)
    if (is_for(*job, backend)) job->hold(reason, ahead);
}

void JobQueue::put_back(JobPtr job) {
  assert(job->state() == v1::QUEUED);
  keep_leads(job->submit().backend());
  line_.push_back(std::move(job));
}

void JobQueue::leave_line(const Job& job) {
  std::erase_if(line_, [&](const JobPtr& queued) { return queued.get() == &job; });
}

/// Who comes before a queued job, or has turns with it.
std::string JobQueue::turn_text(const Job& job) const {
  std::size_t own = 0;
  std::set<std::string_view> others;
  for (const auto& [id, other] : live_) {
    const bool runs = other->state() == v1::RUNNING;
    if (other.get() == &job || !is_for(*other, job.submit().backend())) continue;
    if (!runs && other->state() != v1::QUEUED) continue;
    const auto place = [](const Job& one) {
      return std::pair(-std::int64_t{one.submit().priority()}, one.id());
    };
    if (other->user() != job.user())
      others.insert(other->user());
    else
      own += runs || place(*other) < place(job);
  }
  std::string text;
  if (own > 0)
    text = std::to_string(own) + (own == 1 ? " job of the same user comes before it"
                                           : " jobs of the same user come before it");
  if (!others.empty())
    text += (text.empty() ? "" : "; ") + std::to_string(others.size()) +
            (others.size() == 1 ? " other user has turns" : " other users have turns");
  return text;
}

}  // namespace metamer::service
