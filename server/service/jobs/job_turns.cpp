// Whose turn it is: the line of queued jobs, shares and memory.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <ctime>
#include <set>

#include "server/service/jobs/job_queue.h"

namespace metamer::service {

namespace {

Claim claim_of(const Job& job) { return {job.user(), job.submit().priority(), job.id()}; }

/// That it takes now, of the daemon and of a worker that has it.
std::uint64_t memory_of(const Job& job) {
  return job.state() == v1::RUNNING ? memory_estimate(job.size()) : job.film_bytes();
}

/// "2026-11-27 14:00 UTC"
std::string utc_text(double time) {
  const auto seconds = static_cast<std::time_t>(time);
  std::tm parts{};
  ::gmtime_r(&seconds, &parts);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &parts)};
}

bool is_for(const Job& job, v1::Backend backend) { return job.submit().backend() == backend; }

}  // namespace

JobQueue::JobPtr JobQueue::next(v1::Backend backend) {
  const std::uint64_t taken = memory_taken();
  const std::uint32_t ahead = queued() + running();
  std::vector<Claim> waiting;
  for (const JobPtr& job : line_) {
    if (!is_for(*job, backend)) continue;
    std::string obstacle = this->obstacle(*job, taken);
    if (obstacle.empty()) waiting.push_back(claim_of(*job));
    job->hold(std::move(obstacle), ahead);
  }
  const auto chosen = shares_[backend].choose(waiting);
  if (!chosen) return nullptr;
  JobPtr job = find(waiting[*chosen].order);
  std::erase(line_, job);
  shares_[backend].begin(job->user(), job->share());
  keep_usage(backend);
  return job;
}

bool JobQueue::gives_way(const Job& running) {
  const v1::Backend backend = running.submit().backend();
  if (!work_text(running).empty()) return true;
  const std::uint64_t taken = memory_taken() - memory_of(running);
  std::vector<Claim> rivals{claim_of(running)};
  for (const JobPtr& job : line_)
    if (is_for(*job, backend) && obstacle(*job, taken).empty()) rivals.push_back(claim_of(*job));
  if (shares_[backend].choose(rivals) != std::size_t{0}) return true;
  shares_[backend].begin(running.user(), running.share());
  if (rivals.size() > 1) keep_usage(backend);
  return false;
}

/// Why a queued job can't begin, whosever turn it is; empty: it can. `taken`: of memory.
std::string JobQueue::obstacle(const Job& job, std::uint64_t taken) const {
  if (std::string work = work_text(job); !work.empty()) return work;
  Admission may = admission(job, taken);
  return may.verdict == Admission::Verdict::waits ? std::move(may.reason) : std::string();
}

std::string JobQueue::work_text(const Job& job) const {
  const AccountPtr& owner = job.owner();
  const double most = owner ? most_day_seconds(*owner) : 0;
  if (most <= 0) return {};
  const double now = clock_();
  const auto free = work_.free_at(owner->name, most, now);
  if (!free) return {};
  return fmt::format("{} has had {:.0f} of {:g} s of workers within a day; goes on at {}",
                     owner->name, work_.spent(owner->name, now), most, utc_text(*free));
}

double JobQueue::most_day_seconds(const Account& account) const {
  if (account.admin) return 0;
  return account.max_work.value_or(static_cast<double>(limits_.user_work));
}

std::map<std::string, double> JobQueue::day_seconds() const { return work_.all_spent(clock_()); }

std::optional<std::string> JobQueue::refuse_view(const JobSize& size, std::uint64_t own) const {
  return service::refuse_view(size, memory_taken() - own, limits_.memory);
}

/// By all jobs that have not ended, and all views.
std::uint64_t JobQueue::memory_taken() const {
  std::uint64_t sum = views_memory_();
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
  work_.spend(job.user(), seconds, clock_());
  double& unkept = unkept_seconds_[job.submit().backend()];
  unkept += seconds;
  if (unkept >= most_unkept_seconds) keep_usage(job.submit().backend());
}

/// What was spent is kept as a turn begins and ends while others wait, and now and then.
void JobQueue::keep_usage(v1::Backend backend) {
  if (std::exchange(unkept_seconds_[backend], 0) == 0) return;
  const double now = clock_();
  std::vector<KeptWork> work;
  for (WorkLedger::Entry& entry : work_.take_changes(now))
    work.push_back({std::move(entry.user), entry.hour, entry.seconds});
  if (!store_) return;
  std::vector<KeptLead> leads;
  for (FairShare::Lead& lead : shares_[backend].leads())
    leads.push_back({backend, std::move(lead.user), lead.seconds});
  store_->put_usage(backend, std::move(leads), std::move(work), WorkLedger::first_hour(now));
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
  keep_usage(job->submit().backend());
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
