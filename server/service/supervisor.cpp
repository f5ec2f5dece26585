#include "server/service/supervisor.h"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "server/service/limits.h"

namespace metamer::service {

namespace {

/// The first restart after a failed start waits this long, each further one twice as long.
constexpr std::chrono::milliseconds first_backoff{100};
constexpr std::chrono::milliseconds last_backoff{5000};
/// So many failed starts in a row are no accident: jobs are told instead of kept waiting.
constexpr std::uint32_t hopeless_starts = 3;

std::string seconds(std::chrono::milliseconds duration) {
  return fmt::format("{:g} s", static_cast<double>(duration.count()) / 1000);
}

v1::Failed failure(v1::Failed::Kind kind, std::string reason) {
  v1::Failed failed;
  failed.set_kind(kind);
  failed.set_reason(std::move(reason));
  return failed;
}

}  // namespace

Supervisor::Supervisor(const asio::any_io_executor& executor, Options options, JobQueue& queue)
    : executor_(executor),
      options_(std::move(options)),
      queue_(queue),
      capabilities_signal_(executor, asio::steady_timer::time_point::max()),
      restart_(executor),
      overdue_(executor) {}

void Supervisor::start() { start_worker(); }

void Supervisor::stop() {
  state_ = State::stopped;
  restart_.cancel();
  overdue_.cancel();
  capabilities_signal_.cancel();
  if (worker_) std::exchange(worker_, nullptr)->abandon();
}

bool Supervisor::has_job() const {
  return state_ == State::compiling || state_ == State::rendering || state_ == State::stopping;
}

void Supervisor::start_worker() {
  ++starts_;
  auto worker =
      WorkerProcess::spawn(executor_, options_.command,
                           {[this](v1::WorkerEnvelope message) { on_message(std::move(message)); },
                            [this](const std::string& reason) { on_exit(reason); }});
  state_ = State::starting;
  if (!worker) return on_exit(worker.error().message);
  worker_ = *worker;
  spdlog::info("worker {} started", worker_->pid());
  last_sign_ = Clock::now();
  watch();
}

void Supervisor::on_exit(const std::string& reason) {
  if (state_ == State::stopped) return;
  spdlog::warn("the worker is gone: {}", reason);
  overdue_.cancel();
  worker_.reset();
  last_exit_ = reason;
  const State before = std::exchange(state_, State::down);
  start_was_tried_ = true;
  capabilities_signal_.cancel();

  // Settle what becomes of its job, and wait before another start only where starting itself fails.
  if (before == State::compiling || before == State::rendering) lose_job(reason);
  job_.reset();
  if (before != State::starting && before != State::idle) return start_worker();
  if (++failed_starts_ >= hopeless_starts) fail_queue(reason);
  const auto wait =
      std::min(last_backoff, first_backoff * (1u << std::min(failed_starts_ - 1, 6u)));
  restart_.expires_after(wait);
  restart_.async_wait([this](boost::system::error_code cancelled) {
    if (!cancelled) start_worker();
  });
}

void Supervisor::lose_job(const std::string& reason) {
  if (job_->retry("the worker was lost: " + reason)) return queue_.put_first(job_);
  job_->fail(failure(v1::Failed::WORKER, "the worker was lost twice: " + reason));
  queue_.ended(*job_);
}

void Supervisor::fail_queue(const std::string& reason) {
  while (const auto job = queue_.next()) {
    job->fail(failure(v1::Failed::WORKER, "no worker starts: " + reason));
    queue_.ended(*job);
  }
}

// ---- Time

void Supervisor::watch() {
  auto due = last_sign_ + options_.worker_timeout;
  if (state_ == State::compiling || state_ == State::rendering) {
    due = std::min(due, last_progress_ + options_.stall_timeout);
  }
  if (state_ == State::stopping) due = std::min(due, stop_sent_ + options_.stop_timeout);
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
  const bool busy = state_ == State::compiling || state_ == State::rendering;
  if (busy && now >= last_progress_ + options_.stall_timeout) {
    return distrust("stopped answering: its work stood still for " +
                    seconds(options_.stall_timeout));
  }
  if (state_ == State::stopping && now >= stop_sent_ + options_.stop_timeout) {
    return distrust("did not stop within " + seconds(options_.stop_timeout));
  }
  watch();
}

void Supervisor::distrust(const std::string& what) { worker_->kill(what); }

// ---- Jobs

void Supervisor::work() {
  if (state_ != State::idle) return;
  job_ = queue_.next();
  if (!job_) return;
  job_->start();
  spdlog::info("job {} ({}) started", job_->id(), job_->submit().name());

  v1::WorkerEnvelope message;
  message.set_job_id(job_->id());
  v1::CompileJob& compile = *message.mutable_compile_job();
  compile.set_scene_sha256(job_->submit().scene_sha256());
  *compile.mutable_asset() = job_->submit().asset();
  compile.set_explain(job_->submit().explain());
  compile.set_keep_factors(job_->submit().keep_factors());
  if (job_->method()) *compile.mutable_chosen() = *job_->method();
  worker_->send(std::move(message));
  state_ = State::compiling;
  last_progress_ = Clock::now();
  watch();
}

void Supervisor::interrupt(const Job& job) {
  if ((state_ != State::compiling && state_ != State::rendering) || job_.get() != &job) return;
  send_stop();
  state_ = State::stopping;
  stop_sent_ = Clock::now();
  watch();
}

void Supervisor::send_stop() {
  v1::WorkerEnvelope message;
  message.set_job_id(job_->id());
  message.mutable_stop_job();
  worker_->send(std::move(message));
}

void Supervisor::job_is_over() {
  if (job_->ended()) {
    spdlog::info("job {} {}", job_->id(), word(job_->state()));
    // A cancelled job is off the queue's books already.
    if (job_->state() != v1::CANCELLED) queue_.ended(*job_);
  }
  job_.reset();
  worker_->release_film();
  state_ = State::idle;
  watch();
  work();
}

// ---- Messages

void Supervisor::on_message(v1::WorkerEnvelope message) {
  if (!worker_) return;
  // Until it is ready a worker has shown nothing, however it beats.
  if (state_ != State::starting || message.has_ready()) last_sign_ = Clock::now();
  using Body = v1::WorkerEnvelope;
  switch (message.body_case()) {
    case Body::kReady:
      return on_ready(std::move(*message.mutable_ready()));
    case Body::kHeartbeat:
      return on_heartbeat(message.heartbeat().work());
    case Body::kPlanned:
    case Body::kTileDone:
    case Body::kFactorsPiece:
    case Body::kDone:
    case Body::kStopped:
    case Body::kFailed:
      break;
    case Body::kCompileJob:
    case Body::kRenderTiles:
    case Body::kStopJob:
    case Body::BODY_NOT_SET:
      return distrust("sent a message that workers do not send");
  }

  // An answer about a job that is over was on its way before the worker heard of it.
  if (!has_job() || message.job_id() != job_->id()) return;
  if (state_ == State::stopping) {
    // The plan was on its way when StopJob came; say it again to the worker that now waits.
    if (message.has_planned()) return send_stop();
    const bool over = message.has_done() || message.has_failed() || message.has_stopped();
    return over ? on_stopped() : void();
  }
  last_progress_ = last_sign_;
  if (message.has_planned()) return on_planned(message.planned().plan());
  if (message.has_factors_piece()) return on_factors(message.factors_piece());
  if (message.has_tile_done()) return on_tile(message.tile_done());
  if (message.has_done()) return on_done(std::move(*message.mutable_done()));
  if (message.has_failed()) return on_failed(std::move(*message.mutable_failed()));
}

void Supervisor::on_ready(v1::WorkerReady ready) {
  if (state_ != State::starting) return distrust("said twice that it is ready");
  start_was_tried_ = true;
  capabilities_ = std::move(*ready.mutable_capabilities());
  sandbox_ = ready.sandbox();
  capabilities_signal_.cancel();
  spdlog::info("worker {} is ready; sandbox: {}", worker_->pid(), sandbox_);
  state_ = State::idle;
  work();
}

void Supervisor::on_heartbeat(std::uint64_t work) {
  // It has lived for a while: the next death is another matter than those before.
  if (state_ != State::starting) failed_starts_ = 0;
  if (work == last_work_) return;
  last_work_ = work;
  last_progress_ = last_sign_;
}

void Supervisor::on_planned(const v1::Plan& plan) {
  if (state_ != State::compiling) return distrust("sent a plan that was not asked for");
  if (auto accepted = job_->plan(plan); !accepted) {
    return distrust("sent a plan that can't be: " + accepted.error().message);
  }
  if (job_->submit().check_only()) {
    job_->finish({});
    return job_is_over();
  }
  if (!job_->make_film() || !worker_->size_film(job_->film_bytes())) {
    job_->fail(failure(v1::Failed::SERVER, "no memory for the picture"));
    return job_is_over();
  }
  state_ = State::rendering;
  if (send_next_tiles()) return;
  // It was paused between its last tile and the worker's word that it is done.
  job_->finish({});
  job_is_over();
}

bool Supervisor::send_next_tiles() {
  const auto missing = job_->missing_tiles(options_.tiles_per_batch);
  if (missing.empty()) return false;
  batch_last_ = missing.back();
  batch_missing_ = missing.size();
  v1::WorkerEnvelope message;
  message.set_job_id(job_->id());
  v1::RenderTiles& render = *message.mutable_render_tiles();
  for (const std::uint32_t index : missing) {
    const Rect rect = job_->tiles().rect(index);
    v1::TileRect& tile = *render.add_tile();
    tile.set_x(rect.x);
    tile.set_y(rect.y);
    tile.set_width(rect.width);
    tile.set_height(rect.height);
  }
  render.set_last(batch_missing_ == job_->tiles().size() - job_->tiles_done());
  worker_->send(std::move(message));
  return true;
}

bool Supervisor::copy_tile(const Rect& rect) {
  Film& film = job_->film();
  for (std::uint32_t y = rect.y; y < rect.y + rect.height; ++y) {
    const std::uint64_t offset = (std::uint64_t{y} * film.width() + rect.x) * Film::pixel_bytes;
    if (!worker_->read_film(offset, film.at(rect.x, y), rect.width * Film::pixel_bytes)) {
      return false;
    }
  }
  return true;
}

void Supervisor::on_factors(const v1::FactorsPiece& piece) {
  std::optional<std::uint32_t> index;
  if (piece.has_tile()) {
    index = state_ == State::rendering ? job_->tiles().find(to_rect(piece.tile())) : std::nullopt;
    if (!index || job_->tile_done(*index))
      return distrust("sent factors of a tile that was not asked for");
  } else if (state_ != State::compiling) {
    return distrust("sent factors of a scene that was not asked for");
  }
  if (auto added = job_->add_factors(index, piece.data()); !added)
    distrust("sent factors that can't be kept: " + added.error().message);
}

void Supervisor::on_tile(const v1::TileDone& tile) {
  if (state_ != State::rendering) return distrust("sent a tile that was not asked for");
  const auto index = job_->tiles().find(to_rect(tile.tile()));
  if (!index || *index > batch_last_ || job_->tile_done(*index)) {
    return distrust("sent a tile that was not asked for");
  }
  if (!copy_tile(to_rect(tile.tile()))) return distrust("truncated the shared memory");
  --batch_missing_;
  job_->add_tile(*index, tile.rays());
}

void Supervisor::on_done(v1::JobDone done) {
  if (state_ != State::rendering || batch_missing_ > 0) {
    return distrust("said that a job is done which is not");
  }
  // A large picture goes out in several batches of tiles.
  if (send_next_tiles()) return;
  if (done.has_better() && job_->restart("the promise was broken", done.better())) {
    queue_.put_first(job_);
    return job_is_over();
  }
  job_->finish(std::move(done));
  job_is_over();
}

void Supervisor::on_failed(v1::Failed failed) {
  if (failed.kind() == v1::Failed::UNSPECIFIED) failed.set_kind(v1::Failed::SERVER);
  job_->fail(std::move(failed));
  job_is_over();
}

void Supervisor::on_stopped() { job_is_over(); }

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
  info.set_state(starting ? "starting" : state_ == State::idle ? "idle" : "busy");
  info.set_starts(starts_);
  info.set_last_exit(last_exit_);
  info.set_sandbox(sandbox_);
  return info;
}

}  // namespace metamer::service
