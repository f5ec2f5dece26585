#pragma once

#include <boost/asio.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "metamer/v1/session.pb.h"
#include "server/service/job_queue.h"
#include "server/service/limits.h"
#include "server/service/views.h"
#include "server/service/worker_process.h"

namespace metamer::service {

/// Keeps a backend's worker running and gives it the queue's jobs for it, one at a time, and the
/// views. A worker that dies, hangs or lies costs its job one attempt, ends its views, and nothing
/// else.
class Supervisor {
 public:
  struct Options {
    WorkerCommand command;
    std::chrono::milliseconds worker_timeout{5000};   ///< Without a sign of life.
    std::chrono::milliseconds stall_timeout{120000};  ///< With a job whose work stands still.
    std::chrono::milliseconds stop_timeout{2000};     ///< From StopJob to its answer.
    std::size_t tiles_per_batch = service::tiles_per_batch;  ///< In one RenderTiles.
  };

  Supervisor(const asio::any_io_executor& executor, Options options, JobQueue& queue, Views& views);

  /// Starts the first worker, unless there is one. Without it the first job does.
  void start();
  /// Ends the worker and starts no other.
  void stop();

  /// Gives the worker the next job if it is free. To be called when the queue has grown.
  void work();
  /// Says that `job` was cancelled or paused: the worker is stopped if it has it.
  void interrupt(const Job& job);

  /// Opens a view in the worker, which is started if need be.
  void open(const View& view);
  /// Tells the worker what concerns a view. Without a worker it is lost, and the view too.
  void tell(v1::WorkerEnvelope message);

  /// What the workers can do; empty until the first one has said so.
  const v1::Capabilities& capabilities() const { return capabilities_; }
  /// Waits until they are known or the first worker has failed to start.
  asio::awaitable<void> wait_for_capabilities();
  v1::WorkerInfo info() const;
  v1::Backend backend() const { return options_.command.backend; }

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
  void on_planned(const v1::Plan& plan);
  void on_factors(const v1::FactorsPiece& piece);
  void on_tile(const v1::TileDone& tile);
  void on_verified(std::uint32_t tiles);
  void on_done(v1::JobDone done);
  void on_failed(v1::Failed failed);
  void on_stopped();

  /// Asks for the next batch of missing tiles; false when none is missing.
  bool send_next_tiles();
  void send_check();
  bool give_tiles();
  void send_stop();
  bool copy_tile(const Rect& rect);
  /// Ends the worker because of what it said or did.
  void distrust(const std::string& what);
  void job_is_over();
  bool take_job();
  void lose_job(const std::string& reason);
  void fail_queue(const std::string& reason);
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
  std::shared_ptr<WorkerProcess> worker_;
  JobQueue::JobPtr job_;  // in compiling, rendering and stopping
  std::uint32_t starts_ = 0;
  std::uint32_t failed_starts_ = 0;  // in a row, but for shortages
  std::chrono::milliseconds backoff_{first_backoff};
  std::string last_exit_;
  std::string obstacle_;  // why the worker that starts can't, in its own words
  std::string sandbox_;
  asio::steady_timer restart_;
  asio::steady_timer overdue_;
  Clock::time_point last_sign_;
  Clock::time_point last_progress_;
  Clock::time_point stop_sent_;
  std::uint64_t last_work_ = 0;
  bool says_busy_ = false;        ///< Its last heartbeat.
  std::uint32_t batch_last_ = 0;  // the last tile that was asked for
  std::size_t batch_missing_ = 0;
};

}  // namespace metamer::service
