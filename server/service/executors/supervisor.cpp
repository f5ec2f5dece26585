#include "server/service/executors/supervisor.h"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "server/service/limits.h"
#include "server/service/ops/log.h"
#include "server/service/schedule/fair_share.h"

namespace metamer::service {

namespace {

std::string seconds(std::chrono::milliseconds duration) {
  return fmt::format("{:g} s", static_cast<double>(duration.count()) / 1000);
}

}  // namespace

Supervisor::Supervisor(const asio::any_io_executor& executor, Options options, JobQueue& queue,
                       Views& views)
    : executor_(executor),
      options_(std::move(options)),
      queue_(queue),
      views_(views),
      capabilities_signal_(executor, asio::steady_timer::time_point::max()),
      restart_(executor),
      overdue_(executor) {
  options_.command.backend = options_.lane.backend;
  options_.command.niceness = options_.lane.niceness;
  if (!options_.control_group.empty() && options_.lane.jobs)
    group_ = ControlGroup(options_.control_group, options_.lane.name);
  options_.command.group = group_.path();
}

void Supervisor::start() {
  if (state_ == State::asleep) start_worker();
}

void Supervisor::stop() {
  state_ = State::stopped;
  restart_.cancel();
  overdue_.cancel();
  capabilities_signal_.cancel();
  if (worker_) std::exchange(worker_, nullptr)->abandon();
  assets_.reset();
}

/// Its work may not stand still.
bool Supervisor::is_busy() const {
  return state_ == State::compiling || state_ == State::rendering ||
         (state_ == State::idle && says_busy_);
}

bool Supervisor::has_job() const {
  return state_ == State::compiling || state_ == State::rendering || state_ == State::stopping;
}

void Supervisor::start_worker() {
  ++starts_;
  ended_for_memory_ = group_.ended_for_memory();
  auto worker = spawn();
  state_ = State::starting;
  if (!worker && worker.error().shortage) {
    spdlog::warn("no {} worker starts yet: {}", options_.lane.name, worker.error().message);
    last_exit_ = worker.error().message;
    state_ = State::down;
    hold_queue("waits for a worker: " + last_exit_);
    start_was_tried_ = true;
    capabilities_signal_.cancel();
    return start_again();
  }
  if (!worker) return on_exit(worker.error().message);
  worker_ = *worker;
  spdlog::info("{} worker {} started", options_.lane.name, worker_->pid());
  last_sign_ = Clock::now();
  watch();
}

// ---- Time

void Supervisor::watch() {
  auto due = last_sign_ + options_.worker_timeout;
  if (is_busy()) {
    due = std::min(due, last_progress_ + options_.stall_timeout);
  }
  if (state_ == State::stopping || yields_) due = std::min(due, stop_sent_ + options_.stop_timeout);
  overdue_.expires_at(due);
  overdue_.async_wait([this](boost::system::error_code cancelled) {
    if (!cancelled && worker_) check_overdue();
  });
}

void Supervisor::check_overdue() {
  const auto now = Clock::now();
  if (now >= last_sign_ + options_.worker_timeout) {
    if (state_ == State::starting) {
      return distrust("was not ready within " + seconds(options_.worker_timeout));
    }
    return distrust("stopped answering: no sign of life for " + seconds(options_.worker_timeout));
  }
  if (is_busy() && now >= last_progress_ + options_.stall_timeout) {
    return distrust("stopped answering: its work stood still for " +
                    seconds(options_.stall_timeout));
  }
  if ((state_ == State::stopping || yields_) && now >= stop_sent_ + options_.stop_timeout) {
    return distrust("did not stop within " + seconds(options_.stop_timeout));
  }
  watch();
}

void Supervisor::distrust(const std::string& what) { worker_->kill(what); }

// ---- Jobs

/// The next job whose assets are what they were. False when there is none.
bool Supervisor::take_job() {
  while ((job_ = queue_.next(backend()))) {
    auto obstacle = job_->damage();
    if (!obstacle) {
      Admission may = queue_.admission(*job_);
      if (may.verdict != Admission::Verdict::never) return true;
      obstacle = std::move(may.reason);
    }
    job_->fail(v1::Failed::SERVER, *obstacle);
    queue_.ended(*job_);
  }
  return false;
}

void Supervisor::work() {
  if (!options_.lane.jobs) return;
  if (state_ == State::asleep && queue_.has_work(backend())) return start_worker();
  if (state_ != State::idle) return;
  if (!take_job()) return;
  job_->start();
  const bool anew = job_->worker_seconds() == 0;  // not a further turn, of which there may be many
  log_line(anew ? spdlog::level::info : spdlog::level::debug, fields_of_job(),
           fmt::format("job {} ({}) {}", job_->id(), job_->submit().name(),
                       anew ? "started" : "goes on"));

  v1::WorkerEnvelope message;
  message.set_job_id(job_->id());
  v1::CompileJob& compile = *message.mutable_compile_job();
  compile.set_scene_sha256(job_->submit().scene_sha256());
  *compile.mutable_asset() = job_->submit().asset();
  compile.set_explain(job_->submit().explain());
  compile.set_keep_factors(job_->submit().keep_factors());
  compile.set_prepare(job_->submit().check_only() && job_->submit().prepare());
  if (job_->method()) *compile.mutable_chosen() = *job_->method();
  state_ = State::compiling;
  last_progress_ = taken_ = charged_ = Clock::now();
  told_ = false;
  stage_ = v1::Preparing::UNSPECIFIED;
  ++worker_jobs_;
  had_views_ = false;
  watch();
  // Its attempt is on the disk before the worker hears of it: should it take the daemon along, that
  // counts.
  job_->when_kept([this, start = ++starts_of_jobs_, message = std::move(message)]() mutable {
    if (start != starts_of_jobs_ || state_ != State::compiling) return;
    if (const auto shown = show_assets(); !shown) {
      job_->fail(v1::Failed::SERVER, shown.error().message);
      return job_is_over();
    }
    told_ = true;
    worker_->send(std::move(message));
  });
}

void Supervisor::interrupt(const Job& job) {
  if ((state_ != State::compiling && state_ != State::rendering) || job_.get() != &job) return;
  if (!told_) return job_is_over();
  if (!std::exchange(yields_, false)) send_stop();
  state_ = State::stopping;
  watch();
}

/// The job's tiles have been asked for, or all that comes before the first is there.
void Supervisor::begin_turn() {
  turn_began_ = Clock::now();
  using Seconds = std::chrono::duration<double>;
  turn_ = std::chrono::duration_cast<Clock::duration>(Seconds(
      turn_seconds(Seconds(options_.quantum).count(), Seconds(turn_began_ - taken_).count())));
  turn_tiles_ = 0;
}

void Supervisor::charge_job() {
  if (!job_) return;
  const auto now = Clock::now();
  queue_.spend(*job_, std::chrono::duration<double>(now - std::exchange(charged_, now)).count());
}

/// Stops a job that has had its turn while another is next. Not in the middle of the check of the
/// whole picture, which would begin anew; and only once so many tiles have come that those that are
/// dropped half done, one of each thread, are few.
void Supervisor::consider_yielding() {
  if (state_ != State::rendering || yields_ || batch_missing_ == 0) return;
  if (turn_tiles_ < least_tiles_ || Clock::now() - turn_began_ < turn_) return;
  if (!queue_.gives_way(*job_)) {
    turn_began_ = Clock::now();
    return;
  }
  yields_ = true;
  send_stop();
  watch();
}

void Supervisor::send_stop() {
  v1::WorkerEnvelope message;
  message.set_job_id(job_->id());
  message.mutable_stop_job();
  worker_->send(std::move(message));
  stop_sent_ = Clock::now();
}

void Supervisor::job_is_over() {
  yields_ = false;
  if (job_->ended()) {
    log_line(spdlog::level::info, fields_of_job(),
             fmt::format("job {} {}", job_->id(), word(job_->state())));
    // The queue counted a cancelled job as ended already.
    if (job_->state() != v1::CANCELLED) queue_.ended(*job_);
  }
  job_.reset();
  worker_->release_film();
  (void)show_assets();
  state_ = State::idle;
  limit_memory();
  watch();
  work();
}

// ---- Views

void Supervisor::open(const View& view) {
  // One that is not ready yet gets it with all others.
  if (state_ == State::asleep) return start_worker();
  limit_memory();
  tell(view.opening());
}

void Supervisor::tell(v1::WorkerEnvelope message) {
  const bool ready = state_ == State::idle || has_job();
  if (ready && show_assets_of(message)) worker_->send(std::move(message));
}

// ---- What others ask

asio::awaitable<void> Supervisor::wait_for_capabilities() {
  while (!start_was_tried_ && state_ != State::stopped) {
    co_await capabilities_signal_.async_wait(asio::as_tuple(asio::use_awaitable));
  }
}

v1::WorkerInfo Supervisor::info() const {
  v1::WorkerInfo info;
  info.set_pid(worker_ ? static_cast<std::uint32_t>(worker_->pid()) : 0);
  const bool starting = state_ == State::down || state_ == State::starting;
  info.set_state(state_ == State::asleep ? "asleep"
                 : starting              ? "starting"
                 : state_ == State::idle ? "idle"
                                         : "busy");
  info.set_backend(options_.lane.name);
  info.set_isa(machine_.isa());
  info.set_lanes(machine_.lanes());
  info.set_starts(starts_);
  info.set_last_exit(last_exit_);
  info.set_sandbox(sandbox_.empty() ? sandbox_ : sandbox_ + "; memory: " + memory_text());
  return info;
}

}  // namespace metamer::service
