// What the worker says, and what follows from it.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "common/program/machine.h"
#include "server/service/executors/supervisor.h"
#include "server/service/limits.h"

namespace metamer::service {

void Supervisor::on_message(v1::WorkerEnvelope message) {
  if (!worker_) return;
  // Until it is ready a worker has shown nothing, however it beats.
  if (state_ != State::starting || message.has_ready()) last_sign_ = Clock::now();
  using Body = v1::WorkerEnvelope;
  switch (message.body_case()) {
    case Body::kReady:
      return on_ready(std::move(*message.mutable_ready()));
    case Body::kHeartbeat:
      return on_heartbeat(message.heartbeat());
    case Body::kViewEvent:
      return on_view(std::move(*message.mutable_view_event()));
    case Body::kAssetDamaged:
      if (const auto digest = digest_from_bytes(message.asset_damaged().sha256()))
        assets_->doubt(*digest);
      return;
    case Body::kPlanned:
    case Body::kPreparing:
    case Body::kPrepared:
    case Body::kTileDone:
    case Body::kTilesVerified:
    case Body::kFactorsPiece:
    case Body::kDone:
    case Body::kStopped:
    case Body::kFailed:
      break;
    case Body::kCompileJob:
    case Body::kRenderTiles:
    case Body::kStopJob:
    case Body::kOpenView:
    case Body::kUpdateView:
    case Body::kNextFrame:
    case Body::kCloseView:
    case Body::kProbe:
    case Body::BODY_NOT_SET:
      return distrust("sent a message that workers do not send");
  }

  if (state_ == State::starting && message.has_failed()) {
    obstacle_ = message.failed().reason();
    return;
  }
  // An answer about a job that is over was on its way before the worker heard of it.
  if (!has_job() || message.job_id() != job_->id()) return;
  charge_job();  // before what it says is kept
  if (state_ == State::stopping) {
    // The plan was on its way when StopJob came; say it again to the worker that now waits.
    if (message.has_planned()) return send_stop();
    if (message.has_done()) return on_stopped(std::move(*message.mutable_done()->mutable_record()));
    if (message.has_stopped())
      return on_stopped(std::move(*message.mutable_stopped()->mutable_record()));
    return message.has_failed() ? on_stopped({}) : void();
  }
  last_progress_ = last_sign_;
  if (message.has_preparing()) return on_preparing(message.preparing().stage());
  if (message.has_planned()) return on_planned(message.planned().plan());
  if (message.has_prepared()) return on_prepared(message.prepared().timing());
  if (message.has_factors_piece()) return on_factors(message.factors_piece());
  if (message.has_tile_done()) return on_tile(message.tile_done());
  if (message.has_tiles_verified()) return on_verified(message.tiles_verified().tiles());
  if (message.has_done()) return on_done(std::move(*message.mutable_done()));
  if (message.has_failed()) return on_failed(std::move(*message.mutable_failed()));
  if (message.has_stopped() && yields_)
    return on_yielded(std::move(*message.mutable_stopped()->mutable_record()));
}

void Supervisor::on_ready(v1::WorkerReady ready) {
  if (state_ != State::starting) return distrust("said twice that it is ready");
  start_was_tried_ = true;
  capabilities_ = std::move(*ready.mutable_capabilities());
  sandbox_ = ready.sandbox();
  machine_.set_name(host_name());
  machine_.set_cpu(processor_name());
  if (backend() == v1::GL) {
    machine_.set_gpu(capabilities_.gl().renderer());
  } else {
    machine_.set_isa(ready.isa());
    machine_.set_lanes(ready.lanes());
  }
  capabilities_signal_.cancel();
  state_ = State::idle;
  memory_ = MemoryLimit(worker_->pid());
  worker_jobs_ = 0;
  limit_memory();
  spdlog::info("worker {} is ready; sandbox: {}; memory: {}", worker_->pid(), sandbox_,
               memory_text());
  hold_queue({});
  if (options_.lane.views)
    for (const ViewPtr& view : views_.of(backend())) {
      tell(view->opening());
      for (v1::WorkerEnvelope& frame : view->frames_due()) tell(std::move(frame));
    }
  work();
}

void Supervisor::on_heartbeat(const v1::Heartbeat& beat) {
  // It has run for a while: its exit will not be one of a failed start.
  if (state_ != State::starting) {
    failed_starts_ = 0;
    backoff_ = first_backoff;
  }
  says_busy_ = beat.busy();
  charge_job();
  consider_yielding();
  if (!is_busy() || beat.work() != last_work_) last_progress_ = last_sign_;
  last_work_ = beat.work();
  // What waited for memory may start, since another lane's job has ended.
  work();
}

void Supervisor::on_preparing(v1::Preparing::Stage stage) {
  if (!v1::Preparing::Stage_IsValid(stage) || !job_->add_preparing(stage))
    return distrust("prepares what was not asked for");
  // With its first step the worker has let go of the job before.
  if (std::exchange(stage_, stage) == v1::Preparing::UNSPECIFIED && state_ == State::compiling) {
    memory_.begin(all_memory());
    limit_memory();
  }
}

void Supervisor::on_planned(const v1::Plan& plan) {
  if (state_ != State::compiling) return distrust("sent a plan that was not asked for");
  if (auto accepted = job_->plan(plan); !accepted) {
    return distrust("sent a plan that can't be: " + accepted.error().message);
  }
  if (job_->submit().check_only()) {
    if (job_->submit().prepare()) return;  // Prepared comes
    job_->finish({});
    return job_is_over();
  }
  if (!has_memory()) return job_is_over();
  limit_memory();
  if (!job_->make_film() || !worker_->size_film(job_->film_bytes()) ||
      (job_->verifies() && !give_tiles())) {
    job_->fail(v1::Failed::SERVER, "no memory for the picture");
    return job_is_over();
  }
  state_ = State::rendering;
  least_tiles_ = 4 * std::clamp<std::size_t>(plan.threads(), 1, 256);
  begin_turn();
  if (send_next_tiles()) return;
  // It was paused between its last tile and the worker's word that it is done.
  if (job_->verifies()) return send_check();
  job_->finish({});
  job_is_over();
}

/// For what the plan says. False: the job has failed, or waits again.
bool Supervisor::has_memory() {
  const Admission may = queue_.admission(*job_);
  switch (may.verdict) {
    case Admission::Verdict::starts:
      return true;
    case Admission::Verdict::waits:
      job_->yield(may.reason, queue_.queued());
      queue_.put_back(job_);
      return false;
    case Admission::Verdict::never:
      job_->fail(v1::Failed::SERVER, may.reason);
      return false;
  }
  return true;
}

void Supervisor::on_prepared(const v1::Timing& timing) {
  const bool alone = job_->submit().check_only() && job_->submit().prepare();
  if ((state_ != State::rendering && !alone) || !job_->add_prepared(timing))
    return distrust("prepared what was not asked for");
  stage_ = v1::Preparing::UNSPECIFIED;
  if (!alone) return begin_turn();
  v1::JobDone done;
  *done.mutable_timing() = timing;
  job_->finish(std::move(done));
  job_is_over();
}

void Supervisor::on_view(v1::ViewEvent event) {
  const ViewPtr view = views_.find(event.view_id());
  if (!view) return;
  if (event.updated().has_plan() && !has_memory(*view, event.updated().plan())) return;
  const bool changed_scene = view->changes_scene();
  auto order = view->take(std::move(event));
  if (!order) return distrust(order.error());
  if (changed_scene || view->ended()) (void)show_assets();
  if (*order) tell(*std::move(*order));
}

/// For what the plan of a view says. False: the view has ended.
bool Supervisor::has_memory(View& view, const v1::Plan& plan) {
  const auto why = queue_.refuse_view(view.size_with(plan), view.memory());
  if (!why) return true;
  v1::ViewClosed closed;
  closed.mutable_reason()->set_kind(v1::Failed::SERVER);
  closed.mutable_reason()->set_reason(*why);
  tell(view.closing());
  view.end(std::move(closed));
  (void)show_assets();
  return false;
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

void Supervisor::send_check() {
  batch_missing_ = 0;
  v1::WorkerEnvelope message;
  message.set_job_id(job_->id());
  message.mutable_render_tiles()->set_last(true);
  worker_->send(std::move(message));
}

/// The tiles that an earlier worker has rendered.
bool Supervisor::give_tiles() {
  const Film& film = job_->film();
  for (std::uint32_t index = 0; index < job_->tiles().size(); ++index) {
    if (!job_->tile_done(index)) continue;
    const Rect rect = job_->tiles().rect(index);
    for (std::uint32_t y = rect.y; y < rect.y + rect.height; ++y) {
      const std::uint64_t offset = (std::uint64_t{y} * film.width() + rect.x) * Film::pixel_bytes;
      if (!worker_->write_film(offset, film.at(rect.x, y), rect.width * Film::pixel_bytes))
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
  job_->film().take(to_rect(tile.tile()), worker_->film());
  --batch_missing_;
  job_->add_tile(*index, tile.rays());
  ++queue_.counts().tiles[backend()];
  queue_.counts().rays[backend()] += tile.rays();
  ++turn_tiles_;
  consider_yielding();
}

void Supervisor::on_verified(std::uint32_t tiles) {
  if (state_ != State::rendering || batch_missing_ > 0 || !job_->verifies() ||
      tiles > job_->tiles().size())
    return distrust("verified tiles that were not asked for");
  job_->add_verified(tiles);
}

void Supervisor::on_done(v1::JobDone done) {
  if (state_ != State::rendering || batch_missing_ > 0) {
    return distrust("said that a job is done which is not");
  }
  // A large picture goes out in several batches of tiles. A stop between two of them has no answer.
  if (yields_ && job_->tiles_done() < job_->tiles().size())
    return on_yielded(std::move(*done.mutable_record()));
  if (send_next_tiles()) return;
  job_->add_run(std::move(*done.mutable_record()));
  if (done.has_better() && job_->restart("the promise was broken", done.better())) {
    queue_.put_back(job_);
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

void Supervisor::on_stopped(v1::RunRecord record) {
  job_->add_run(std::move(record));
  job_is_over();
}

void Supervisor::on_yielded(v1::RunRecord record) {
  job_->add_run(std::move(record));
  const std::string work = queue_.work_text(*job_);
  if (job_->yield(work.empty() ? "others have their turn" : work, queue_.queued()))
    queue_.put_back(job_);
  job_is_over();
}

}  // namespace metamer::service
