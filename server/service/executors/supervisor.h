#pragma once

#include <boost/asio.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "metamer/v1/session.pb.h"
#include "server/service/assets/asset_folder.h"
#include "server/service/executors/control_group.h"
#include "server/service/executors/executor.h"
#include "server/service/executors/lane.h"
#include "server/service/executors/memory_limit.h"
#include "server/service/executors/worker_process.h"
#include "server/service/jobs/job_queue.h"
#include "server/service/limits.h"
#include "server/service/views/views.h"

namespace metamer::service {

struct LogFields;

/// Keeps a lane's worker running and gives it the queue's jobs for it, one at a time, and the
/// views, where it is for these. A worker that dies, hangs or lies costs its job one attempt, ends
/// its views, and nothing else.
class Supervisor final : public Executor, public ViewHost {
 public:
  struct Options {
    WorkerCommand command;  ///< Its backend and niceness are the lane's.
    Lane lane = cpu_jobs;
    /// A divided control group, below which the lane has its own; empty: none is delegated.
    std::filesystem::path control_group;
    /// Nobody will mend what keeps workers from starting: jobs are not held then, but fail.
    bool gives_up = false;
    std::chrono::milliseconds worker_timeout{5000};   ///< Without a sign of life.
    std::chrono::milliseconds stall_timeout{120000};  ///< With a job whose work stands still.
    std::chrono::milliseconds stop_timeout{2000};     ///< From StopJob to its answer.
    /// A job's turn while others wait; see turn_seconds() where it takes long to begin one.
    std::chrono::milliseconds quantum{2000};
    std::size_t tiles_per_batch = service::tiles_per_batch;  ///< In one RenderTiles.
  };

  Supervisor(const asio::any_io_executor& executor, Options options, JobQueue& queue, Views& views);

  void start() override;
  void stop() override;
  void work() override;
  void interrupt(const Job& job) override;
  void charge_job() override;
  /// Empty until the first worker has said so.
  const v1::Capabilities& capabilities() const override { return capabilities_; }
  asio::awaitable<void> wait_for_capabilities() override;
  v1::WorkerInfo info() const override;
  std::uint32_t losses() const override { return losses_; }

  void open(const View& view) override;
  void tell(v1::WorkerEnvelope message) override;

 private:
  enum class State {
    asleep,    // none was needed yet, or none can start
    down,      // none runs; the restart timer does
    starting,  // no WorkerReady yet
    idle,
    compiling,  // CompileJob is sent
    rendering,  // RenderTiles is sent
    stopping,   // StopJob is sent
    stopped,    // for good
  };
  using Clock = std::chrono::steady_clock;
  /// The first restart after a failed start waits this long, each further one twice as long.
  static constexpr std::chrono::milliseconds first_backoff{100};

  // The worker's life.
  void start_worker();
  tl::expected<std::shared_ptr<WorkerProcess>, WorkerProcess::SpawnError> spawn();
  void on_message(v1::WorkerEnvelope message);
  void on_exit(const std::string& reason);
  void start_again();
  void give_up();
  void watch();  // sets the timer to the next moment at which something is overdue
  void check_overdue();

  // What it says. Each is called in the right state only.
  void on_ready(v1::WorkerReady ready);
  void on_heartbeat(const v1::Heartbeat& beat);
  void on_view(v1::ViewEvent event);
  void on_preparing(v1::Preparing::Stage stage);
  void on_planned(const v1::Plan& plan);
  void on_prepared(const v1::Timing& timing);
  void on_factors(const v1::FactorsPiece& piece);
  void on_tile(const v1::TileDone& tile);
  void on_verified(std::uint32_t tiles);
  void on_done(v1::JobDone done);
  void on_failed(v1::Failed failed);
  void on_stopped(v1::RunRecord record);
  void on_yielded(v1::RunRecord record);
  /// What a worker that is lost can't say any more: which machine it was on.
  v1::RunRecord record_of_lost() const;

  /// Asks for the next batch of missing tiles; false when none is missing.
  bool send_next_tiles();
  void send_check();
  bool give_tiles();
  bool has_memory();
  bool has_memory(View& view, const v1::Plan& plan);
  void send_stop();
  void begin_turn();
  void consider_yielding();
  /// Ends the worker because of what it said or did.
  void distrust(const std::string& what);
  Result<void> show_assets(std::uint64_t closed_view = 0);
  bool show_assets_of(const v1::WorkerEnvelope& message);
  void job_is_over();
  bool take_job();
  void lose_job(const std::string& reason);
  void fail_job_for_memory();
  /// Has the system hold the worker of a lane of jobs to what its job may take, or, without one, to
  /// what all may.
  void limit_memory();
  std::uint64_t all_memory() const;      // that jobs may take together
  std::uint64_t allowed_memory() const;  // to its job
  bool views_share_worker() const;
  std::string memory_text() const;  // what holds the worker to its limit
  LogFields fields_of_job() const;  // what the log says of it, if there is one
  void hold_queue(const std::string& reason);
  void fail_queue(const std::string& reason);
  void end_views(const std::string& reason);
  v1::Backend backend() const { return options_.lane.backend; }
  bool is_wanted() const;
  bool has_job() const;
  bool is_busy() const;

  asio::any_io_executor executor_;
  Options options_;
  JobQueue& queue_;
  Views& views_;
  v1::Capabilities capabilities_;
  asio::steady_timer capabilities_signal_;
  bool start_was_tried_ = false;

  State state_ = State::asleep;
  std::unique_ptr<AssetFolder> assets_;  // what the worker sees
  std::shared_ptr<WorkerProcess> worker_;
  JobQueue::JobPtr job_;                                     // in compiling, rendering and stopping
  bool told_ = false;                                        // the worker, of job_
  v1::Preparing::Stage stage_ = v1::Preparing::UNSPECIFIED;  // that it has come to
  MemoryLimit memory_;
  ControlGroup group_;
  std::uint64_t ended_for_memory_ = 0;  // in the group, when the worker was started
  std::uint64_t worker_jobs_ = 0;       // that this worker has been given
  bool had_views_ = false;              // since it was given the last
  std::uint64_t starts_of_jobs_ = 0;
  std::uint32_t starts_ = 0;
  std::uint32_t losses_ = 0;
  std::uint32_t failed_starts_ = 0;  // in a row, but for shortages
  std::chrono::milliseconds backoff_{first_backoff};
  std::string last_exit_;
  std::string obstacle_;  // why the worker that starts can't, in its own words
  std::string sandbox_;
  v1::MachineRecord machine_;  // that its workers run on
  asio::steady_timer restart_;
  asio::steady_timer overdue_;
  Clock::time_point last_sign_;
  Clock::time_point last_progress_;
  Clock::time_point stop_sent_;
  std::uint64_t last_work_ = 0;
  bool says_busy_ = false;        ///< Its last heartbeat.
  std::uint32_t batch_last_ = 0;  // the last tile that was asked for
  std::size_t batch_missing_ = 0;
  Clock::time_point charged_;     // what the worker has spent on its job is charged until then
  Clock::time_point taken_;       // when it was sent the job;
  Clock::time_point turn_began_;  // its first tile, or the turn after that one
  Clock::duration turn_{};        // how long one lasts, while others wait
  std::size_t turn_tiles_ = 0;    // that have come since it has had the worker,
  std::size_t least_tiles_ = 0;   // and have to
  bool yields_ = false;           // StopJob is sent for that, in rendering
};

}  // namespace metamer::service
