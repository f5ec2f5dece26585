#include "server/service/jobs/job.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "common/program/build_id.h"
#include "server/service/jobs/run_sum.h"
#include "server/service/limits.h"
#include "server/service/text.h"
#include "server/service/wall_clock.h"

namespace metamer::service {

Job::Job(std::uint64_t id, v1::Submit submit, AssetHolds assets, std::uint32_t ahead,
         AccountPtr owner)
    : id_(id),
      submit_(std::move(submit)),
      assets_(std::move(assets)),
      owner_(std::move(owner)),
      submitted_at_(wall_clock()) {
  append(queued_event(ahead));
}

double Job::between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

double Job::seconds() const { return between(submitted_, Clock::now()); }

v1::JobSummary Job::summary() const {
  v1::JobSummary summary;
  summary.set_job_id(id_);
  summary.set_name(submit_.name());
  summary.set_state(state_);
  summary.set_tiles_done(tiles_done_);
  summary.set_tiles(grid_.size());
  summary.set_last_sequence(log_.last_sequence());
  summary.set_age(seconds());
  if (owner_) summary.set_user(owner_->name);
  summary.set_backend(submit_.backend());
  summary.set_priority(submit_.priority());
  summary.set_worker_seconds(worker_seconds_);
  summary.set_picture_bytes(picture_bytes());
  summary.set_submitted_at(submitted_at_);
  summary.set_reason(shortened(reason_, max_reason));
  if (submit_.has_series()) *summary.mutable_series() = submit_.series();
  return summary;
}

std::optional<std::string> Job::damage() const {
  const auto damaged = assets_.damaged();
  if (!damaged) return std::nullopt;
  for (const v1::AssetName& asset : submit_.asset())
    if (asset.sha256() == to_bytes(*damaged))
      return assets_.describe_damage(*damaged, asset.name());
  return assets_.describe_damage(*damaged, "the scene");
}

bool Job::take(Step step) {
  const auto next = next_state(state_, step);
  if (!next) return false;

  // Add up the time that was spent in the state that is left.
  const auto now = Clock::now();
  if (state_ == v1::QUEUED) queued_seconds_ += between(state_since_, now);
  if (state_ == v1::RUNNING) {
    running_seconds_ += between(state_since_, now);
    if (film_.ok()) render_seconds_ += between(render_since_, now);
  }
  state_since_ = now;
  state_ = *next;
  reason_.clear();
  return true;
}

void Job::hold(std::string reason, std::uint32_t ahead) {
  if (state_ != v1::QUEUED) return;
  const bool is_news = reason_.empty() && !reason.empty();
  reason_ = std::move(reason);
  if (is_news) append(queued_event(ahead, reason_));
}

void Job::note(std::string where) {
  if (state_ == v1::RUNNING) reason_ = std::move(where);
}

bool Job::start() {
  if (!take(Step::start)) return false;
  attempt_tiles_ = 0;
  prepared_ = false;
  // What a lost worker left unfinished comes again.
  scene_factors_.clear();
  for (std::uint32_t i = 0; i < factors_.size(); ++i) {
    if (done_[i]) continue;
    factor_bytes_ -= factors_[i].size();
    factors_[i].clear();
  }
  render_since_ = Clock::now();
  v1::JobEvent event;
  event.mutable_started()->set_attempt(losses_ + 1);
  append(std::move(event));
  return true;
}

bool Job::retry(const std::string& reason) {
  if (losses_ + 1 >= max_losses || !take(Step::retry)) return false;
  ++losses_;
  v1::JobEvent event;
  event.mutable_retrying()->set_reason(reason);
  append(std::move(event));
  return true;
}

bool Job::yield(const std::string& reason, std::uint32_t ahead) {
  if (!take(Step::yield)) return false;
  reason_ = reason;
  append(queued_event(ahead, reason));
  return true;
}

bool Job::restart(const std::string& reason, const v1::Method& better) {
  assert(planned_);
  PreviewSums preview(width_, height_);
  if (restarted_ || !take(Step::retry)) return false;
  restarted_ = replans_ = true;
  method_ = better;
  log_.drop_pictures();
  preview_ = std::move(preview);
  void_tiles();
  v1::JobEvent event;
  event.mutable_retrying()->set_reason(reason);
  event.mutable_retrying()->set_from_start(true);
  append(std::move(event));
  return true;
}

bool Job::pause() {
  if (!take(Step::pause)) return false;
  v1::JobEvent event;
  event.mutable_paused();
  append(std::move(event));
  return true;
}

bool Job::resume(std::uint32_t ahead) {
  if (!take(Step::resume)) return false;
  append(queued_event(ahead));
  return true;
}

void Job::add_run(v1::RunRecord part, std::optional<std::uint32_t> tiles) {
  metamer::service::add_run(std::move(part), tiles.value_or(attempt_tiles_), run_);
  if (state_ == v1::PAUSED) put(false);
}

bool Job::finish(v1::JobDone done) {
  if (!take(Step::finish)) return false;
  v1::Timing& timing = *done.mutable_timing();
  timing.set_queued(queued_seconds_);
  // What was timed from the first RenderTiles on includes what the worker did before its first
  // tile.
  timing.set_render(std::max(0.0, render_seconds_ - done.setup() - timing.verify()));
  timing.set_total(running_seconds_);
  timing.set_rays(rays_);
  v1::JobEvent event;
  *event.mutable_finished()->mutable_timing() = std::move(timing);
  if (store_ && !scene_factors_.empty()) write_scene_factors();
  if (done.has_accuracy()) *event.mutable_finished()->mutable_accuracy() = done.accuracy();
  if (run_.machine_size() > 0) {
    balance_tiles(grid_.size(), run_);
    run_.set_server_build(build_id());
    *event.mutable_finished()->mutable_record() = run_;
  }
  append_last(std::move(event));
  return true;
}

bool Job::fail(v1::Failed failed) {
  if (!take(Step::fail)) return false;
  reason_ = failed.reason();
  v1::JobEvent event;
  *event.mutable_failed() = std::move(failed);
  append_last(std::move(event));
  return true;
}

bool Job::fail(v1::Failed::Kind kind, std::string reason) {
  v1::Failed failed;
  failed.set_kind(kind);
  failed.set_reason(std::move(reason));
  return fail(std::move(failed));
}

bool Job::cancel() {
  if (!take(Step::cancel)) return false;
  log_.drop_pictures();
  film_ = Film();
  factors_.clear();
  factor_bytes_ = 0;
  v1::JobEvent event;
  event.mutable_cancelled();
  append_last(std::move(event));
  if (store_) {
    on_disk_->forget();
    store_->remove_tiles(id_);
  }
  return true;
}

void Job::prioritize(std::int32_t priority) {
  submit_.set_priority(priority);
  put(false);
}

void Job::spend(double seconds) {
  worker_seconds_ += seconds;
  if (worker_seconds_ - worker_seconds_put_ >= most_unkept_seconds) put(false);
}

std::uint64_t Job::picture_bytes() const {
  return on_disk_ ? on_disk_->size() : film_bytes() + factor_bytes_;
}

Result<v1::JobEvent> Job::event(const EventLog::Entry& entry, bool factors) const {
  v1::JobEvent event;
  if (entry.event) {
    event = *entry.event;
    if (factors && event.has_planned()) {
      if (!scene_on_disk_ || !scene_factors_.empty()) {
        event.mutable_planned()->set_factors(scene_factors_);
      } else {
        auto contents = on_disk_->read(*scene_on_disk_);
        if (!contents) return tl::unexpected(contents.error());
        event.mutable_planned()->set_factors(std::move(contents->factors));
      }
    }
  } else {
    const Rect rect = grid_.rect(entry.tile);
    v1::Tile& tile = *event.mutable_tile();
    tile.set_x(rect.x);
    tile.set_y(rect.y);
    tile.set_width(rect.width);
    tile.set_height(rect.height);
    if (film_.ok()) {
      tile.set_xyz(film_.copy(rect));
      if (factors && !factors_.empty()) tile.set_factors(factors_[entry.tile]);
    } else {
      auto contents = on_disk_->read(entries_[entry.tile]);
      if (!contents) return tl::unexpected(contents.error());
      tile.set_xyz(std::move(contents->xyz));
      if (factors) tile.set_factors(std::move(contents->factors));
    }
  }
  event.set_job_id(id_);
  event.set_sequence(entry.sequence);
  event.set_time(entry.time);
  return event;
}

v1::JobEvent Job::queued_event(std::uint32_t ahead, const std::string& reason) const {
  v1::JobEvent event;
  event.mutable_queued()->set_position(ahead);
  event.mutable_queued()->set_reason(reason);
  return event;
}

void Job::append(v1::JobEvent event) {
  log_.append(std::move(event), seconds());
  put(true);
  wake();
}

void Job::append_last(v1::JobEvent event) {
  assets_.clear();
  preview_ = PreviewSums();
  unseen_tiles_ = {};
  log_.append_last(std::move(event), seconds());
  ended_at_ = wall_clock();
  put(true);
  wake();
}

void Job::wake() {
  for (const auto& wake : wakes_) wake();
}

Job::Watcher::Watcher(std::shared_ptr<Job> job, bool previews, std::function<void()> wake)
    : job_(std::move(job)),
      previews_(previews),
      wake_(job_->wakes_.insert(job_->wakes_.end(), std::move(wake))) {
  if (previews_) ++job_->preview_watchers_;
}

Job::Watcher::~Watcher() {
  if (previews_) --job_->preview_watchers_;
  job_->wakes_.erase(wake_);
}

}  // namespace metamer::service
