#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/problem.h"
#include "common/wire/picture_factors.h"
#include "metamer/v1/jobs.pb.h"
#include "metamer/v1/plan.pb.h"
#include "metamer/v1/worker.pb.h"
#include "server/service/assets/asset_store.h"
#include "server/service/jobs/event_log.h"
#include "server/service/jobs/film.h"
#include "server/service/jobs/job_state.h"
#include "server/service/jobs/preview.h"
#include "server/service/jobs/tiles.h"
#include "server/service/schedule/admission.h"
#include "server/service/store/job_store.h"

namespace metamer::service {

/// A scene to render: its state, its picture so far, and the log of what happened. It knows nothing
/// of workers and sockets. Each step appends its event and wakes the watchers; a step that the
/// state does not allow returns false and does nothing.
class Job : public std::enable_shared_from_this<Job> {
 public:
  using Clock = std::chrono::steady_clock;

  /// The queue holds `ahead` jobs that come first. No owner: nobody in particular.
  Job(std::uint64_t id, v1::Submit submit, AssetHolds assets, std::uint32_t ahead,
      AccountPtr owner = {});
  /// A job as it was kept; its assets were held anew, unless it has ended. One that ran, or waited,
  /// is queued again by go_on().
  Job(v1::JobRecord record, AssetHolds assets, AccountPtr owner, JobStore& store);
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  std::uint64_t id() const { return id_; }
  const v1::Submit& submit() const { return submit_; }
  const AccountPtr& owner() const { return owner_; }
  /// Whose it is, and its weight beside others; empty, and 1: nobody's in particular.
  std::string_view user() const { return owner_ ? std::string_view(owner_->name) : ""; }
  double share() const { return owner_ ? owner_->share : 1; }
  /// None once it has ended.
  const AssetHolds& assets() const { return assets_; }
  v1::JobState state() const { return state_; }
  bool ended() const { return is_end(state_); }
  double ended_at() const { return ended_at_; }  ///< Seconds since 1970.
  bool planned() const { return planned_; }
  /// That of the plan; null before. A picture is of one method, whatever another worker would
  /// choose.
  const v1::Method* method() const { return planned_ ? &method_ : nullptr; }
  std::size_t film_bytes() const { return film_.ok() ? film_.bytes() : 0; }
  /// What its picture takes: memory, or of one that is kept the disk.
  std::uint64_t picture_bytes() const;
  /// What says how much memory it takes while it runs.
  JobSize size() const;
  v1::JobSummary summary() const;
  /// Which of its assets is damaged in the store; nothing when none is.
  std::optional<std::string> damage() const;

  // What outlives the process; see job_keeping.cpp.
  /// Keeps it from now on. Its events are given to watchers once they are on the disk.
  void keep_in(JobStore& store);
  /// After a start: what ran, or waited, is queued again. Its tiles stay where they are of this
  /// `build`. False: it has failed, since it took daemons with it.
  bool go_on(const std::string& build, std::uint32_t ahead);
  /// The server ends in the middle of it, which is not the job's fault.
  void set_aside();
  /// What it has come to could not be kept so far.
  bool unkept() const { return keep_again_; }
  /// Keeps it anew where that could not be done.
  void keep_again();
  /// Its tiles are of workers of this build.
  void set_build(std::string build) { build_ = std::move(build); }
  /// Once all that it has come to is kept; at once where nothing is.
  void when_kept(std::function<void()> then);
  /// Reads where the tiles of an ended job are, which was kept. Errors: the file can't be read.
  Result<void> find_tiles();
  /// Its file is removed: whoever watches it reads on.
  void hold_picture();

  /// Says what a queued job waits for, besides the `ahead` ones; nothing: for no more than these.
  void hold(std::string reason, std::uint32_t ahead);
  /// Says where a running job is rendered, where that is not one machine's doing.
  void note(std::string where);
  /// Among its owner's jobs: higher first.
  void prioritize(std::int32_t priority);
  bool start();
  /// The worker was lost: the job is queued again (true), until it has lost max_losses.
  bool retry(const std::string& reason);
  /// Its turn is over: it is queued again, with the tiles that it has. That is no loss.
  bool yield(const std::string& reason, std::uint32_t ahead);
  /// A worker has spent so many seconds more on it; kept with what happens to it, and now and then.
  void spend(double seconds);
  double worker_seconds() const { return worker_seconds_; }
  /// Its promise was broken: it is queued again, without its tiles, for `better`.
  bool restart(const std::string& reason, const v1::Method& better);
  bool pause();
  bool resume(std::uint32_t ahead);
  /// What an attempt that is over came to, as its worker or the task of a cluster says. `tiles`: of
  /// it that are in the picture; nothing: all since the last start.
  void add_run(v1::RunRecord part, std::optional<std::uint32_t> tiles = std::nullopt);
  /// `done` as the last worker gives it, whose record was added; what spans several attempts
  /// (queued, render, total, rays) is filled in here.
  bool finish(v1::JobDone done);
  bool fail(v1::Failed failed);
  bool fail(v1::Failed::Kind kind, std::string reason);
  /// Drops what was rendered.
  bool cancel();

  /// Gives the memory of an ended job's picture back. Its tiles can't be read any more.
  void drop_picture();
  bool picture_dropped() const { return picture_dropped_; }

  /// Takes the plan of a running job and makes the film. Errors, with the state as it was: numbers
  /// beyond the limits, another picture than the plan of an earlier attempt had.
  Result<void> plan(const v1::Plan& plan);
  /// Says what is being made before the first tile. False: since the last start all was said to be
  /// there, or a tile has come.
  bool add_preparing(v1::Preparing::Stage stage);
  /// Says that all is there, and what it took. False: likewise, or there is no plan.
  bool add_prepared(const v1::Timing& timing);
  /// False when there is no memory for the film of the plan.
  bool make_film();

  const TileGrid& tiles() const { return grid_; }
  /// The first `most` tiles that are not done, in rendering order.
  std::vector<std::uint32_t> missing_tiles(std::size_t most) const;
  std::uint32_t tiles_done() const { return tiles_done_; }
  bool tile_done(std::uint32_t index) const { return done_[index]; }
  /// Its plan says that the whole picture is held against the reference.
  bool verifies() const { return verifies_; }
  Film& film() { return film_; }
  /// Takes a piece of the factors of a tile that is not done, or, without one, of the scene. Where
  /// all come to more than `most` bytes, this tile and those that follow have none: a picture
  /// outlives its factors. Errors, with nothing taken: more than a tile may have.
  Result<void> add_factors(std::optional<std::uint32_t> index, const std::string& piece,
                           std::uint64_t most = wire::max_picture_factors);
  /// Says that the film now holds tile `index`, which was not done. Adds progress and a preview
  /// where they are due.
  void add_tile(std::uint32_t index, std::uint64_t rays);
  /// All tiles are done, and that many of them verified.
  void add_verified(std::uint32_t tiles);

  /// What a watcher reads. The pixels of a tile are put in from the film, and
  /// with `factors` what is kept of these.
  const EventLog& log() const { return log_; }
  /// Errors: the disk has not what was written to it.
  Result<v1::JobEvent> event(const EventLog::Entry& entry, bool factors) const;

  /// Keeps a job and calls `wake` after each of its events, in the middle of the step: that may
  /// schedule work, but neither change the job nor end a watcher. Previews are made only while
  /// somebody wants them.
  class Watcher {
   public:
    Watcher(std::shared_ptr<Job> job, bool previews, std::function<void()> wake);
    ~Watcher();
    Watcher(Watcher&&) = delete;

    const Job& job() const { return *job_; }

   private:
    std::shared_ptr<Job> job_;
    bool previews_;
    std::list<std::function<void()>>::iterator wake_;  // in job_->wakes_
  };

 private:
  static double between(Clock::time_point from, Clock::time_point to);
  double seconds() const;  // since it was submitted
  bool take(Step step);
  void append(v1::JobEvent event);
  void append_last(v1::JobEvent event);
  void append_planned(const v1::Plan& plan);
  void note_numbers(const v1::Plan& plan);
  void append_progress(std::uint32_t verified = 0);
  void add_preview();
  void wake();
  v1::JobEvent queued_event(std::uint32_t ahead, const std::string& reason = {}) const;
  v1::JobRecord record() const;
  void put(bool event);
  void kept(const std::optional<StoreTrouble>& trouble);
  void hide_what_is_not_kept();
  void write_tile(TileFile::Entry entry);
  std::uint32_t deaths_without_progress() const;
  void lose_tile(std::uint32_t index);
  void write_scene_factors();
  void write_all_tiles();
  void void_tiles();
  bool load_film();

  std::uint64_t id_;
  v1::Submit submit_;
  AssetHolds assets_;
  AccountPtr owner_;
  v1::JobState state_ = v1::QUEUED;
  EventLog log_;
  std::list<std::function<void()>> wakes_;  // of the watchers
  std::size_t preview_watchers_ = 0;

  std::uint32_t losses_ = 0;  // workers lost
  v1::RunRecord run_;         // of attempts that are over
  double worker_seconds_ = 0;
  double worker_seconds_put_ = 0;  // of them, those that were asked to be kept
  bool planned_ = false;
  bool prepared_ = false;  // in this attempt
  bool restarted_ = false;
  bool verifies_ = false;
  bool replans_ = false;  // restarted, and its new plan has not come yet
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  std::uint32_t tile_size_ = 0;
  std::uint64_t triangles_ = 0;
  std::uint32_t spectra_ = 0;
  std::uint32_t bands_ = 0;
  v1::Method method_;
  TileGrid grid_;
  Film film_;
  PreviewSums preview_;
  std::vector<std::uint32_t> unseen_tiles_;  // that are not in it yet, as nobody has asked
  std::vector<bool> done_;                   // by tile
  std::string scene_factors_;
  std::vector<std::string> factors_;  // by tile, where the job keeps them
  std::uint64_t factor_bytes_ = 0;
  bool too_many_factors_ = false;  // a tile had to go without
  bool picture_dropped_ = false;
  std::uint32_t tiles_done_ = 0;
  std::uint32_t attempt_tiles_ = 0;  // of them, since the last start
  std::uint64_t rays_ = 0;
  std::string reason_;  // why it failed, or still waits; or where it runs

  JobStore* store_ = nullptr;                     // where it is kept, if anywhere
  std::unique_ptr<TileFile> on_disk_;             // its tiles, where it is kept
  std::vector<TileFile::Entry> entries_;          // by tile
  std::optional<TileFile::Entry> scene_on_disk_;  // the factors of the scene
  bool tiles_unknown_ = false;  // ended before this process began: find_tiles() reads them
  std::string build_;
  struct Unkept {
    std::uint64_t first_event;  // that the put() is for; none: the largest number
    std::uint64_t reserved;
  };
  std::deque<Unkept> unkept_;        // puts on their way
  std::uint64_t reserved_ = 0;       // numbers below it were asked to be kept
  std::uint64_t reserved_kept_ = 0;  // and are
  bool keep_again_ = false;
  bool losing_ = false;                     // its tiles could not be written
  double submitted_at_ = 0, ended_at_ = 0;  // seconds since 1970

  Clock::time_point submitted_ = Clock::now();
  Clock::time_point state_since_ = submitted_;
  Clock::time_point render_since_ = submitted_;
  Clock::time_point whole_since_ = submitted_;
  Clock::time_point next_progress_ = submitted_;
  Clock::time_point next_preview_ = submitted_;
  double queued_seconds_ = 0;
  double running_seconds_ = 0;
  double render_seconds_ = 0;  // of earlier attempts
};

}  // namespace metamer::service
