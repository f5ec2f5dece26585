#include "server/service/job.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "common/scene/limits.h"
#include "common/wire/frame.h"
#include "server/service/limits.h"
#include "server/service/text.h"

namespace metamer::service {

namespace {

double between(Job::Clock::time_point from, Job::Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

Job::Job(std::uint64_t id, v1::Submit submit, AssetHolds assets, std::uint32_t ahead,
         AccountPtr owner)
    : id_(id), submit_(std::move(submit)), assets_(std::move(assets)), owner_(std::move(owner)) {
  append(queued_event(ahead));
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
  summary.set_reason(shortened(reason_, max_reason));
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

bool Job::start() {
  if (!take(Step::start)) return false;
  attempt_tiles_ = 0;
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
  if (losses_ > 0 || !take(Step::retry)) return false;
  ++losses_;
  v1::JobEvent event;
  event.mutable_retrying()->set_reason(reason);
  append(std::move(event));
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
  done_.assign(grid_.size(), false);
  tiles_done_ = 0;
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
  if (done.has_accuracy()) *event.mutable_finished()->mutable_accuracy() = done.accuracy();
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
  return true;
}

void Job::drop_picture() {
  assert(ended());
  film_ = Film();
  factors_ = {};
  factor_bytes_ = 0;
  picture_dropped_ = true;
  wake();
}

Result<void> Job::plan(const v1::Plan& plan) {
  assert(state_ == v1::RUNNING);
  // A worker is not trusted: its numbers decide how much memory is taken here.
  const std::uint64_t pixels = std::uint64_t{plan.width()} * plan.height();
  if (pixels == 0 || plan.width() > limits::max_side || plan.height() > limits::max_side ||
      pixels > limits::max_pixels) {
    return problem("a picture of " + std::to_string(plan.width()) + " x " +
                   std::to_string(plan.height()) + " pixels");
  }
  if (plan.tile_size() < 8 || plan.tile_size() > 256 || plan.tile_size() % 8 != 0) {
    return problem("tiles of " + std::to_string(plan.tile_size()) + " pixels");
  }
  if (planned_) {
    const bool same =
        plan.width() == width_ && plan.height() == height_ && plan.tile_size() == tile_size_;
    if (!same) return problem("another picture than the attempt before");
    // Watchers begin their picture anew with each plan that they hear of.
    if (std::exchange(replans_, false)) append_planned(plan);
    return {};
  }

  // Last what says that all is there: memory may run out on the way.
  width_ = plan.width();
  height_ = plan.height();
  tile_size_ = plan.tile_size();
  method_ = plan.method();
  verifies_ = plan.verify_cost() > 0;
  grid_ = TileGrid(width_, height_, tile_size_);
  append_planned(plan);
  planned_ = true;
  return {};
}

void Job::append_planned(const v1::Plan& plan) {
  v1::JobEvent event;
  *event.mutable_planned()->mutable_plan() = plan;
  append(std::move(event));
}

bool Job::make_film() {
  assert(planned_);
  render_since_ = whole_since_ = Clock::now();
  if (film_.ok()) return true;
  preview_ = PreviewSums(width_, height_);
  done_.assign(grid_.size(), false);
  film_ = Film(width_, height_);
  return film_.ok();
}

std::vector<std::uint32_t> Job::missing_tiles(std::size_t most) const {
  std::vector<std::uint32_t> missing;
  for (std::uint32_t i = 0; i < grid_.size() && missing.size() < most; ++i) {
    if (!done_[i]) missing.push_back(i);
  }
  return missing;
}

Result<void> Job::add_factors(std::optional<std::uint32_t> index, const std::string& piece) {
  if (!submit_.keep_factors()) return problem("factors that nobody asked for");
  if (index) factors_.resize(grid_.size());
  std::string& own = index ? factors_[*index] : scene_factors_;
  if (own.size() + piece.size() > wire::max_factors)
    return problem("more factors than a tile may have");
  if (factor_bytes_ + piece.size() > max_job_factors)
    return problem("the picture has more factors than are kept, " +
                   std::to_string(max_job_factors) + " bytes");
  own += piece;
  if (index) factor_bytes_ += piece.size();
  return {};
}

void Job::add_tile(std::uint32_t index, std::uint64_t rays) {
  assert(state_ == v1::RUNNING && !done_[index]);
  done_[index] = true;
  ++tiles_done_;
  ++attempt_tiles_;
  rays_ += rays;
  preview_.add(film_, grid_.rect(index));
  log_.append_tile(index, seconds());

  const auto now = Clock::now();
  whole_since_ = now;
  if (now >= next_progress_ || tiles_done_ == grid_.size()) {
    next_progress_ = now + progress_interval;
    append_progress();
  }
  if (preview_watchers_ > 0 && (now >= next_preview_ || tiles_done_ == grid_.size())) {
    next_preview_ = now + progress_interval;
    v1::JobEvent event;
    *event.mutable_preview() = preview_.encode();
    log_.replace_preview(std::move(event), seconds());
  }
  wake();
}

void Job::add_verified(std::uint32_t tiles) {
  append_progress(tiles);
  wake();
}

void Job::append_progress(std::uint32_t verified) {
  v1::JobEvent event;
  v1::Progress& progress = *event.mutable_progress();
  progress.set_tiles_done(tiles_done_);
  progress.set_tiles(grid_.size());
  progress.set_rays(rays_);
  progress.set_tiles_verified(verified);
  const auto now = Clock::now();
  const double attempt = between(render_since_, now);
  progress.set_seconds(render_seconds_ + attempt);
  progress.set_seconds_left(verified > 0
                                ? between(whole_since_, now) * (grid_.size() - verified) / verified
                                : attempt * (grid_.size() - tiles_done_) / attempt_tiles_);
  log_.replace_progress(std::move(event), seconds());
}

v1::JobEvent Job::event(const EventLog::Entry& entry, bool factors) const {
  v1::JobEvent event;
  if (entry.event) {
    event = *entry.event;
    if (factors && event.has_planned()) event.mutable_planned()->set_factors(scene_factors_);
  } else {
    const Rect rect = grid_.rect(entry.tile);
    v1::Tile& tile = *event.mutable_tile();
    tile.set_x(rect.x);
    tile.set_y(rect.y);
    tile.set_width(rect.width);
    tile.set_height(rect.height);
    tile.set_xyz(film_.copy(rect));
    if (factors && !factors_.empty()) tile.set_factors(factors_[entry.tile]);
  }
  event.set_job_id(id_);
  event.set_sequence(entry.sequence);
  event.set_time(entry.time);
  return event;
}

v1::JobEvent Job::queued_event(std::uint32_t ahead) const {
  v1::JobEvent event;
  event.mutable_queued()->set_position(ahead);
  return event;
}

void Job::append(v1::JobEvent event) {
  log_.append(std::move(event), seconds());
  wake();
}

void Job::append_last(v1::JobEvent event) {
  assets_.clear();
  preview_ = PreviewSums();
  log_.append_last(std::move(event), seconds());
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
