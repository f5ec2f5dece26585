// What of a job outlives the process.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "server/service/jobs/job.h"
#include "server/service/jobs/run_sum.h"
#include "server/service/limits.h"
#include "server/service/wall_clock.h"

namespace metamer::service {

namespace {

constexpr std::uint64_t no_event = std::numeric_limits<std::uint64_t>::max();
/// The newest of a job's events, besides its plans: one that yields all the time has thousands.
constexpr std::size_t kept_events = 256;
constexpr const char* started_anew = "the server was started anew";
/// Daemons that ended in the middle of a job, none of which got a tile of it done: more than happen
/// by accident to one that has just begun.
constexpr std::uint32_t most_deaths = 8;

Job::Clock::time_point steady_time(double seconds_since_1970) {
  const std::chrono::duration<double> ago(std::max(0.0, wall_clock() - seconds_since_1970));
  return Job::Clock::now() - std::chrono::duration_cast<Job::Clock::duration>(ago);
}

}  // namespace

Job::Job(v1::JobRecord record, AssetHolds assets, AccountPtr owner, JobStore& store)
    : id_(record.job_id()),
      submit_(std::move(*record.mutable_submit())),
      assets_(std::move(assets)),
      owner_(std::move(owner)),
      state_(record.state()),
      losses_(record.losses()),
      run_(std::move(*record.mutable_run())),
      worker_seconds_(record.worker_seconds()),
      restarted_(record.restarted()),
      rays_(record.rays()),
      reason_(record.reason()),
      store_(&store),
      on_disk_(store.tiles(record.job_id())),
      build_(record.build()),
      reserved_(record.next_sequence()),
      reserved_kept_(record.next_sequence()),
      submitted_at_(record.submitted_at()),
      ended_at_(record.ended_at()),
      submitted_(steady_time(record.submitted_at())),
      queued_seconds_(record.queued_seconds()),
      running_seconds_(record.running_seconds()),
      render_seconds_(record.render_seconds()) {
  std::vector<EventLog::Entry> events;
  for (v1::JobEvent& event : *record.mutable_event()) {
    const std::uint64_t sequence = event.sequence();
    const double time = event.time();
    events.push_back({sequence, time, 0, std::make_shared<const v1::JobEvent>(std::move(event))});
  }
  log_.restore(std::move(events), record.next_sequence(), ended());
  if (record.has_plan()) {
    note_numbers(record.plan());
    method_ = record.has_method() ? record.method() : record.plan().method();
    planned_ = true;
    done_.assign(grid_.size(), false);
  }
  tiles_unknown_ = true;
  if (!ended()) return;
  // Its picture is read when somebody asks for it.
  tiles_done_ = state_ == v1::FINISHED ? grid_.size() : 0;
  on_disk_->set_size(record.picture_bytes());
}

void Job::keep_in(JobStore& store) {
  store_ = &store;
  on_disk_ = store.tiles(id_);
  put(true);
}

v1::JobRecord Job::record() const {
  v1::JobRecord record;
  record.set_job_id(id_);
  if (owner_) record.set_user(owner_->name);
  *record.mutable_submit() = submit_;
  // Without its tiles it is not finished: it would have to be rendered again.
  const bool unfinished = losing_ && state_ == v1::FINISHED;
  record.set_state(unfinished ? v1::RUNNING : state_);
  record.set_losses(losses_);
  record.set_restarted(restarted_);
  if (planned_) {
    record.mutable_plan()->set_width(width_);
    record.mutable_plan()->set_height(height_);
    record.mutable_plan()->set_tile_size(tile_size_);
    record.mutable_plan()->set_triangles(triangles_);
    record.mutable_plan()->set_spectra(spectra_);
    record.mutable_plan()->set_bands(bands_);
    record.mutable_plan()->set_verify_cost(verifies_ ? 1 : 0);
    *record.mutable_method() = method_;
  }
  const std::size_t count = log_.events().size();
  for (std::size_t i = 0; i < count; ++i) {
    const EventLog::Entry& entry = log_.events()[i];
    if (i + kept_events < count && !entry.event->has_planned()) continue;
    if (unfinished && entry.event->has_finished()) continue;
    v1::JobEvent& event = *record.add_event();
    event = *entry.event;
    event.set_sequence(entry.sequence);
    event.set_time(entry.time);
  }
  record.set_next_sequence(reserved_);
  record.set_submitted_at(submitted_at_);
  record.set_ended_at(ended_at_);
  record.set_queued_seconds(queued_seconds_);
  record.set_running_seconds(running_seconds_);
  record.set_render_seconds(render_seconds_);
  record.set_rays(rays_);
  record.set_reason(reason_);
  record.set_build(build_);
  record.set_picture_bytes(on_disk_ ? on_disk_->size() : 0);
  record.set_worker_seconds(worker_seconds_);
  if (run_.machine_size() > 0) *record.mutable_run() = run_;
  return record;
}

/// `event`: the newest event is what it is for; else numbers for further ones.
void Job::put(bool event) {
  if (!store_) return;
  worker_seconds_put_ = worker_seconds_;
  reserved_ = log_.last_sequence() + 1 + sequence_reserve;
  unkept_.push_back({event ? log_.last_sequence() : no_event, reserved_});
  hide_what_is_not_kept();
  const bool sync = tiles_done_ > 0 && (state_ == v1::FINISHED || state_ == v1::PAUSED);
  store_->put(record(), sync ? on_disk_.get() : nullptr,
              [job = weak_from_this()](const std::optional<StoreTrouble>& trouble) {
                if (const auto self = job.lock()) self->kept(trouble);
              });
}

void Job::kept(const std::optional<StoreTrouble>& trouble) {
  reserved_kept_ = unkept_.front().reserved;
  unkept_.pop_front();
  // What can't be kept now happened all the same: watchers hear of it, and it is kept later.
  losing_ = losing_ || *on_disk_->lost();
  keep_again_ = trouble.has_value() || losing_;
  hide_what_is_not_kept();
  const bool rests = ended() || state_ == v1::PAUSED;
  if (rests && unkept_.empty() && !trouble && !losing_) {
    film_ = Film();
    factors_ = {};
    factor_bytes_ = 0;
    if (scene_on_disk_) scene_factors_.clear();
  }
  wake();
}

void Job::hide_what_is_not_kept() {
  std::uint64_t first = reserved_kept_ == 0 ? no_event : reserved_kept_;
  for (const Unkept& unkept : unkept_) first = std::min(first, unkept.first_event);
  log_.hide_from(first);
}

void Job::keep_again() {
  if (!keep_again_ || !unkept_.empty()) return;
  if (losing_ && film_.ok()) write_all_tiles();
  put(false);
}

void Job::set_aside() {
  if (state_ != v1::RUNNING || !take(Step::retry)) return;
  put(false);
}

void Job::when_kept(std::function<void()> then) {
  if (!store_) return then();
  store_->settle([then = std::move(then)](const std::optional<StoreTrouble>&) { then(); });
}

/// A tile that the film has.
void Job::write_tile(TileFile::Entry entry) {
  std::string record =
      on_disk_->encode(entry, film_.copy(grid_.rect(entry.tile)),
                       factors_.empty() ? std::string_view() : factors_[entry.tile]);
  entries_.resize(grid_.size());
  entries_[entry.tile] = entry;
  store_->write_tile(*on_disk_, entry.offset, std::move(record),
                     [job = weak_from_this()](const std::optional<StoreTrouble>& trouble) {
                       const auto self = job.lock();
                       if (self && trouble) self->losing_ = self->keep_again_ = true;
                     });
  if (log_.last_sequence() + sequence_reserve / 2 > reserved_) put(false);
}

void Job::write_scene_factors() {
  TileFile::Entry entry{.tile = TileFile::scene};
  std::string record = on_disk_->encode(entry, {}, scene_factors_);
  scene_on_disk_ = entry;
  store_->write_tile(*on_disk_, entry.offset, std::move(record), {});
}

/// Where some could not be written: the film has them all.
void Job::write_all_tiles() {
  losing_ = false;
  on_disk_->forget();
  for (std::uint32_t index = 0; index < grid_.size(); ++index)
    if (done_[index]) write_tile(entries_[index]);
  if (!scene_factors_.empty() && ended()) write_scene_factors();
}

/// What was rendered is of no use any more.
void Job::void_tiles() {
  done_.assign(grid_.size(), false);
  tiles_done_ = 0;
  unseen_tiles_.clear();
  forget_tiles(run_);
  if (!store_) return;
  on_disk_->forget();
  store_->cut_tiles(id_, on_disk_->size());
}

void Job::hold_picture() {
  if (!on_disk_ || film_.ok()) return;
  (void)find_tiles();
  on_disk_->open();
}

Result<void> Job::find_tiles() {
  if (!tiles_unknown_ || !store_) return {};
  const std::uint64_t before = on_disk_->size();
  const auto found = on_disk_->scan();
  // What an ended one takes stays what was counted for it, whatever its file has become.
  if (!found || ended()) on_disk_->set_size(before);
  if (!found) return tl::unexpected(found.error());
  tiles_unknown_ = false;
  entries_.assign(grid_.size(), {});
  std::vector<EventLog::Entry> tiles;
  std::uint32_t whole = 0;
  for (const TileFile::Entry& entry : *found) {
    if (entry.tile == TileFile::scene) {
      scene_on_disk_ = entry;
      continue;
    }
    if (entry.tile >= grid_.size()) continue;
    if (!done_[entry.tile]) ++whole;
    done_[entry.tile] = true;
    entries_[entry.tile] = entry;
    tiles.push_back({entry.sequence, entry.time, entry.tile, {}});
  }
  // One that was rendered again, since the disk had lost it, is there as it came last.
  std::erase_if(tiles, [&](const EventLog::Entry& tile) {
    return tile.sequence != entries_[tile.tile].sequence;
  });
  log_.restore_tiles(tiles);
  if (state_ == v1::FINISHED && !submit_.check_only() && whole != grid_.size()) {
    return problem("of its " + std::to_string(grid_.size()) + " tiles " + std::to_string(whole) +
                   " are in " + on_disk_->path().string());
  }
  tiles_done_ = whole;
  return {};
}

/// Daemons that have ended in the middle of it since its newest tile, the last one included: one
/// that ended all of them would do so for ever.
std::uint32_t Job::deaths_without_progress() const {
  std::uint64_t newest = 0;
  for (const TileFile::Entry& entry : entries_) newest = std::max(newest, entry.sequence);
  std::uint32_t deaths = 1;
  for (const EventLog::Entry& entry : log_.events())
    deaths += entry.sequence > newest && entry.event->retrying().reason() == started_anew;
  return deaths;
}

/// The disk has lost it.
void Job::lose_tile(std::uint32_t index) {
  spdlog::error("job {}: tile {} is rendered again, the disk has lost it", id_, index);
  log_.drop_tile(index);
  done_[index] = false;
  --tiles_done_;
}

bool Job::go_on(const std::string& build, std::uint32_t ahead) {
  assert(!ended());
  const bool ran = state_ == v1::RUNNING;
  const auto found = planned_ ? find_tiles() : Result<void>();
  tiles_unknown_ = false;
  if (!found) spdlog::error("job {} begins anew: {}", id_, found.error().message);
  if (planned_) store_->cut_tiles(id_, on_disk_->size());  // what a crash left half written
  for (std::uint32_t index = 0; found && planned_ && index < grid_.size(); ++index)
    if (done_[index] && !on_disk_->read(entries_[index])) lose_tile(index);

  if (ran && deaths_without_progress() >= most_deaths) {
    fail(v1::Failed::WORKER, "the server ended " + std::to_string(most_deaths) +
                                 " times in the middle of it, without a further tile");
    return false;
  }

  v1::JobEvent event;
  if (planned_ && (build != build_ || !found)) {
    void_tiles();
    run_.Clear();  // of another program
    planned_ = false;
    log_.drop_pictures();
    event.mutable_retrying()->set_reason(found ? "the server was updated" : found.error().message);
    event.mutable_retrying()->set_from_start(true);
  } else if (ran) {
    event.mutable_retrying()->set_reason(started_anew);
  } else {
    event = queued_event(ahead);
    event.mutable_queued()->set_reason(started_anew);
  }
  build_ = build;
  if (state_ == v1::PAUSED) return put(false), true;
  state_ = v1::QUEUED;
  state_since_ = Clock::now();
  append(std::move(event));
  return true;
}

/// The film of a job that was kept, with what is done of it; tiles that the disk has lost are
/// rendered again.
bool Job::load_film() {
  preview_ = PreviewSums(width_, height_);
  unseen_tiles_.clear();
  film_ = Film(width_, height_);
  if (!film_.ok()) return false;
  if (submit_.keep_factors()) factors_.resize(grid_.size());
  for (std::uint32_t index = 0; index < grid_.size(); ++index) {
    if (!done_[index]) continue;
    const Rect rect = grid_.rect(index);
    auto contents = on_disk_->read(entries_[index]);
    if (!contents || contents->xyz.size() != rect.width * rect.height * Film::pixel_bytes) {
      lose_tile(index);
      continue;
    }
    film_.paste(rect, contents->xyz);
    unseen_tiles_.push_back(index);
    if (submit_.keep_factors()) {
      factor_bytes_ += contents->factors.size();
      factors_[index] = std::move(contents->factors);
    }
  }
  return true;
}

}  // namespace metamer::service
