// A worker that is gone: what becomes of its job, its views, and of who waits for another.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <limits>
#include <thread>

#include "server/service/executors/supervisor.h"
#include "server/service/limits.h"
#include "server/service/ops/log.h"

namespace metamer::service {

namespace {

constexpr std::chrono::milliseconds last_backoff{5000};
/// So many failed starts in a row are no accident: whoever waits is told.
constexpr std::uint32_t hopeless_starts = 3;

/// That a worker starts.
std::uint32_t threads_of(const WorkerCommand& command) {
  return command.threads > 0 ? command.threads : std::max(1u, std::thread::hardware_concurrency());
}

/// What it was short of memory for.
const char* purpose_of(v1::Preparing::Stage stage) {
  switch (stage) {
    case v1::Preparing::READING:
      return "to read its files";
    case v1::Preparing::HIERARCHY:
      return "for the hierarchy of its meshes";
    case v1::Preparing::PLANNING:
      return "to look at pilot pixels";
    case v1::Preparing::TABLES:
      return "for its method's tables";
    case v1::Preparing::UNSPECIFIED:
    case v1::Preparing_Stage_Preparing_Stage_INT_MIN_SENTINEL_DO_NOT_USE_:
    case v1::Preparing_Stage_Preparing_Stage_INT_MAX_SENTINEL_DO_NOT_USE_:
      break;
  }
  return "to render it";
}

}  // namespace

void Supervisor::on_exit(const std::string& reason) {
  if (state_ == State::stopped) return;
  ++losses_;
  LogFields fields = fields_of_job();
  fields.reason = reason + (obstacle_.empty() ? "" : ": ") + obstacle_;
  log_line(spdlog::level::warn, fields, fmt::format("the {} worker is gone", options_.lane.name));
  overdue_.cancel();
  const bool for_memory =
      worker_ && worker_->ran_out_of_memory(group_.ended_for_memory() > ended_for_memory_);
  worker_.reset();
  assets_.reset();
  if (!obstacle_.empty()) return give_up();
  last_exit_ = reason;
  says_busy_ = false;
  const State before = std::exchange(state_, State::down);
  start_was_tried_ = true;
  capabilities_signal_.cancel();

  // Settle what becomes of its job, and wait before another start only where starting itself fails.
  charge_job();
  yields_ = false;
  // A worker that had the job alone would end as this one did.
  const bool again = !for_memory || worker_jobs_ > 1 || had_views_;
  if (before == State::compiling || before == State::rendering)
    again ? lose_job(reason) : fail_job_for_memory();
  job_.reset();
  if (before != State::starting) end_views("the worker was lost: " + reason);
  if (before != State::starting && before != State::idle) return start_worker();
  if (++failed_starts_ >= hopeless_starts) {
    end_views("no worker starts: " + reason);
    if (options_.gives_up) fail_queue(reason);
    hold_queue("no worker starts: " + reason);
  }
  if (is_wanted()) return start_again();
  state_ = State::asleep;
}

void Supervisor::start_again() {
  restart_.expires_after(backoff_);
  backoff_ = std::min(last_backoff, 2 * backoff_);
  restart_.async_wait([this](boost::system::error_code cancelled) {
    // It may have run out just before it was cancelled.
    if (!cancelled && state_ == State::down) start_worker();
  });
}

/// A lane of views alone has none while nobody looks.
bool Supervisor::is_wanted() const { return options_.lane.jobs || !views_.of(backend()).empty(); }

/// Says why no worker can start, and tries anew when it is next asked for.
void Supervisor::give_up() {
  last_exit_ = std::exchange(obstacle_, {});
  state_ = State::asleep;
  start_was_tried_ = true;
  capabilities_signal_.cancel();
  fail_queue(last_exit_);
}

v1::RunRecord Supervisor::record_of_lost() const {
  v1::RunRecord record;
  *record.add_machine() = machine_;
  return record;
}

void Supervisor::lose_job(const std::string& reason) {
  job_->add_run(record_of_lost());
  if (job_->retry("the worker was lost: " + reason)) return queue_.put_back(job_);
  job_->fail(v1::Failed::WORKER,
             fmt::format("the worker was lost {} times: {}", max_losses, reason));
  queue_.ended(*job_);
}

void Supervisor::fail_job_for_memory() {
  job_->fail(
      v1::Failed::SERVER,
      fmt::format("needs more memory than it may take: about {} were estimated, {} are "
                  "allowed, and not enough {}",
                  mib(memory_estimate(job_->size())), mib(allowed_memory()), purpose_of(stage_)));
  queue_.ended(*job_);
}

std::uint64_t Supervisor::all_memory() const {
  const std::uint64_t set = queue_.limits().memory;
  return set > 0 ? set : std::numeric_limits<std::uint64_t>::max();
}

std::uint64_t Supervisor::allowed_memory() const {
  return memory_allowance(job_->size(), threads_of(options_.command), options_.lane.driver_bytes);
}

bool Supervisor::views_share_worker() const {
  return options_.lane.views && !views_.of(backend()).empty();
}

/// Views change all the time: a job that shares its worker with them may take what all may.
void Supervisor::limit_memory() {
  if (!options_.lane.jobs) return;
  had_views_ = had_views_ || views_share_worker();
  group_.allow(all_memory());
  if (!has_job() || views_share_worker()) return memory_.allow(all_memory());
  memory_.allow(allowed_memory());
  log_line(spdlog::level::debug, fields_of_job(),
           fmt::format("job {} takes about {}, and may ask for {}", job_->id(),
                       mib(memory_estimate(job_->size())), mib(allowed_memory())));
}

std::string Supervisor::memory_text() const {
  if (!options_.lane.jobs) return "not limited: views are admitted by estimates";
  return memory_.describe() +
         (group_.path().empty() ? "" : ", and by a control group for the lane");
}

LogFields Supervisor::fields_of_job() const {
  if (!job_) return {};
  return {.user = job_->owner() ? job_->owner()->name : std::string(), .job = job_->id()};
}

void Supervisor::hold_queue(const std::string& reason) {
  if (options_.lane.jobs) queue_.hold(backend(), reason);
}

void Supervisor::fail_queue(const std::string& reason) {
  while (const auto job = options_.lane.jobs ? queue_.next(backend()) : nullptr) {
    job->fail(v1::Failed::WORKER, "no worker starts: " + reason);
    queue_.ended(*job);
  }
  end_views("no worker starts: " + reason);
}

void Supervisor::end_views(const std::string& reason) {
  if (options_.lane.views) views_.end(backend(), reason);
}

}  // namespace metamer::service
