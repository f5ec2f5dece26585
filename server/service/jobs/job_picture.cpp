// What the workers make of a job: its plan, what they prepare, its tiles, and how far it is.

#include <algorithm>
#include <cassert>
#include <utility>

#include "common/digest.h"
#include "common/scene/limits.h"
#include "common/wire/frame.h"
#include "server/service/jobs/job.h"
#include "server/service/limits.h"

namespace metamer::service {

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
  note_numbers(plan);
  method_ = plan.method();
  append_planned(plan);
  planned_ = true;
  return {};
}

void Job::note_numbers(const v1::Plan& plan) {
  width_ = plan.width();
  height_ = plan.height();
  tile_size_ = plan.tile_size();
  triangles_ = plan.triangles();
  spectra_ = plan.spectra();
  bands_ = plan.bands();
  verifies_ = plan.verify_cost() > 0;
  grid_ = TileGrid(width_, height_, tile_size_);
}

void Job::append_planned(const v1::Plan& plan) {
  v1::JobEvent event;
  *event.mutable_planned()->mutable_plan() = plan;
  append(std::move(event));
}

JobSize Job::size() const {
  const auto scene = digest_from_bytes(submit_.scene_sha256());
  const AssetHolds::Pictures pictures = assets_.pictures();
  return {.asset_bytes = assets_.bytes(),
          .scene_bytes = scene ? assets_.bytes_of(*scene) : 0,
          .pixels = std::uint64_t{width_} * height_,
          .triangles = triangles_,
          .spectra = spectra_,
          .bands = bands_,
          .keeps_factors = submit_.keep_factors(),
          .picture_values = pictures.values,
          .largest_picture = pictures.largest};
}

bool Job::add_preparing(v1::Preparing::Stage stage) {
  if (prepared_ || attempt_tiles_ > 0) return false;
  v1::JobEvent event;
  event.mutable_preparing()->set_stage(stage);
  log_.replace_preparing(std::move(event), seconds());
  wake();
  return true;
}

bool Job::add_prepared(const v1::Timing& timing) {
  if (prepared_ || !planned_ || attempt_tiles_ > 0) return false;
  prepared_ = true;
  v1::JobEvent event;
  v1::Timing& setup = *event.mutable_prepared()->mutable_timing();
  setup.set_compile(timing.compile());
  setup.set_acceleration(timing.acceleration());
  setup.set_pilot(timing.pilot());
  setup.set_prepare(timing.prepare());
  append(std::move(event));
  return true;
}

bool Job::make_film() {
  assert(planned_);
  render_since_ = whole_since_ = Clock::now();
  if (film_.ok()) return true;
  if (tiles_done_ > 0) return load_film();
  preview_ = PreviewSums(width_, height_);
  unseen_tiles_.clear();
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

Result<void> Job::add_factors(std::optional<std::uint32_t> index, const std::string& piece,
                              std::uint64_t most) {
  if (!submit_.keep_factors()) return problem("factors that nobody asked for");
  if (index) factors_.resize(grid_.size());
  std::string& own = index ? factors_[*index] : scene_factors_;
  if (own.size() + piece.size() > wire::max_factors)
    return problem("more factors than a tile may have");
  if (index && (too_many_factors_ || factor_bytes_ + piece.size() > most)) {
    too_many_factors_ = true;
    factor_bytes_ -= own.size();
    own.clear();
    return {};
  }
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
  unseen_tiles_.push_back(index);
  log_.append_tile(index, seconds());
  if (store_)
    write_tile({.tile = index, .sequence = log_.last_sequence(), .rays = rays, .time = seconds()});

  const auto now = Clock::now();
  whole_since_ = now;
  if (now >= next_progress_ || tiles_done_ == grid_.size()) {
    next_progress_ = now + progress_interval;
    append_progress();
  }
  if (preview_watchers_ > 0 && (now >= next_preview_ || tiles_done_ == grid_.size())) {
    next_preview_ = now + progress_interval;
    add_preview();
  }
  wake();
}

/// Of the tiles so far; after so many that nobody has watched, of some of these at a time.
void Job::add_preview() {
  constexpr std::size_t most_pixels = 4u << 20;  // 10 ms
  const std::size_t most_tiles = most_pixels / (std::size_t{tile_size_} * tile_size_);
  std::size_t added = 0;
  while (!unseen_tiles_.empty() && (added < most_tiles || tiles_done_ == grid_.size())) {
    preview_.add(film_, grid_.rect(unseen_tiles_.back()));
    unseen_tiles_.pop_back();
    ++added;
  }
  v1::JobEvent event;
  *event.mutable_preview() = preview_.encode();
  log_.replace_preview(std::move(event), seconds());
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

void Job::drop_picture() {
  assert(ended());
  on_disk_.reset();
  film_ = Film();
  factors_ = {};
  factor_bytes_ = 0;
  picture_dropped_ = true;
  wake();
}

}  // namespace metamer::service
