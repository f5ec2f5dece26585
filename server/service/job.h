#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/problem.h"
#include "metamer/v1/jobs.pb.h"
#include "metamer/v1/plan.pb.h"
#include "metamer/v1/worker.pb.h"
#include "server/service/asset_store.h"
#include "server/service/event_log.h"
#include "server/service/film.h"
#include "server/service/job_state.h"
#include "server/service/preview.h"
#include "server/service/tiles.h"

namespace metamer::service {

/// A scene to render: its state, its picture so far, and the log of what happened. It knows nothing
/// of workers and sockets. Each step appends its event and wakes the watchers; a step that the
/// state does not allow returns false and does nothing.
class Job {
 public:
  using Clock = std::chrono::steady_clock;

  /// The queue holds `ahead` jobs that come first. No owner: nobody in particular.
  Job(std::uint64_t id, v1::Submit submit, AssetHolds assets, std::uint32_t ahead,
      AccountPtr owner = {});
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  std::uint64_t id() const { return id_; }
  const v1::Submit& submit() const { return submit_; }
  const AccountPtr& owner() const { return owner_; }
  v1::JobState state() const { return state_; }
  bool ended() const { return is_end(state_); }
  bool planned() const { return planned_; }
  /// That of the plan; null before. A picture is of one method, whatever another worker would
  /// choose.
  const v1::Method* method() const { return planned_ ? &method_ : nullptr; }
  std::size_t film_bytes() const { return film_.ok() ? film_.bytes() : 0; }
  /// The memory that its picture takes.
  std::uint64_t picture_bytes() const { return film_bytes() + factor_bytes_; }
  v1::JobSummary summary() const;
  /// Which of its assets is damaged in the store; nothing when none is.
  std::optional<std::string> damage() const;

  /// Says what a queued job waits for, besides those ahead of it.
  void hold(std::string reason) { reason_ = std::move(reason); }
  bool start();
  /// The worker was lost: the first time the job is queued again (true), then it has to fail.
  bool retry(const std::string& reason);
  /// Its promise was broken: it is queued again, without its tiles, for `better`.
  bool restart(const std::string& reason, const v1::Method& better);
  bool pause();
  bool resume(std::uint32_t ahead);
  /// `done` as the last worker gives it; what spans several attempts (queued, render, total, rays)
  /// is filled in here.
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
  /// Takes a piece of the factors of a tile that is not done, or, without one, of the scene.
  /// Errors, with nothing taken: more than is kept, of a tile or in all.
  Result<void> add_factors(std::optional<std::uint32_t> index, const std::string& piece);
  /// Says that the film now holds tile `index`, which was not done. Adds progress and a preview
  /// where they are due.
  void add_tile(std::uint32_t index, std::uint64_t rays);
  /// All tiles are done, and that many of them verified.
  void add_verified(std::uint32_t tiles);

  /// What a watcher reads. The pixels of a tile are put in from the film, and
  /// with `factors` what is kept of these.
  const EventLog& log() const { return log_; }
  v1::JobEvent event(const EventLog::Entry& entry, bool factors) const;

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
  double seconds() const;  // since it was submitted
  bool take(Step step);
  void append(v1::JobEvent event);
  void append_last(v1::JobEvent event);
  void append_planned(const v1::Plan& plan);
  void append_progress(std::uint32_t verified = 0);
  void wake();
  v1::JobEvent queued_event(std::uint32_t ahead) const;

  std::uint64_t id_;
  v1::Submit submit_;
  AssetHolds assets_;
  AccountPtr owner_;
  v1::JobState state_ = v1::QUEUED;
  EventLog log_;
  std::list<std::function<void()>> wakes_;  // of the watchers
  std::size_t preview_watchers_ = 0;

  std::uint32_t losses_ = 0;  // workers lost
  bool planned_ = false;
  bool restarted_ = false;
  bool verifies_ = false;
  bool replans_ = false;  // restarted, and its new plan has not come yet
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  std::uint32_t tile_size_ = 0;
  v1::Method method_;
  TileGrid grid_;
  Film film_;
  PreviewSums preview_;
  std::vector<bool> done_;  // by tile
  std::string scene_factors_;
  std::vector<std::string> factors_;  // by tile, where the job keeps them
  std::uint64_t factor_bytes_ = 0;
  bool picture_dropped_ = false;
  std::uint32_t tiles_done_ = 0;
  std::uint32_t attempt_tiles_ = 0;  // of them, since the last start
  std::uint64_t rays_ = 0;
  std::string reason_;  // why it failed, or still waits

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
