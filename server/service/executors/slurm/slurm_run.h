#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "metamer/v1/batch.pb.h"
#include "server/service/assets/asset_folder.h"
#include "server/service/executors/slurm/spool.h"
#include "server/service/executors/slurm/task_book.h"
#include "server/service/executors/tile_ranges.h"
#include "server/service/jobs/job_queue.h"

namespace metamer::service {

/// One job while tasks of a cluster render it: first one that plans it, and begins with the
/// picture; then as many as there are ranges; last, where something was promised, one that measures
/// what came of it. It knows orders and results, and neither Slurm nor files.
class SlurmRun {
 public:
  struct Options {
    std::string build;  ///< Of the worker.
    /// That the tasks of a plan take at least, by what the first took.
    std::chrono::milliseconds task_time{10'000};
    /// That the first one renders for.
    std::chrono::milliseconds pilot_time{2'000};
  };
  /// A job that has just started; `folder` is where its results are looked for, `assets` what its
  /// tasks see.
  SlurmRun(JobQueue::JobPtr job, JobQueue& queue, std::unique_ptr<AssetFolder> assets,
           std::filesystem::path folder, const Options& options);

  Job& job() const { return *job_; }
  const std::filesystem::path& folder() const { return folder_; }

  /// Its attempt is on the disk: from now on there are orders.
  void begin() { begun_to_order_ = true; }
  /// An order that nobody has yet; it is out from now on. Nothing: there is none, now.
  std::optional<v1::BatchOrder> next_order();
  /// How many orders nobody has.
  std::size_t waiting() const;
  /// The picture that an order's task will want to read, by the name that the order says.
  std::string picture_bytes() const;
  /// An order's task is known by this.
  void submitted(std::uint64_t attempt, TaskKey key);

  void take(FoundResult result);
  /// Nothing will come of an attempt; what `counts` is the job's doing, and thrice its end.
  void lose(std::uint64_t attempt, const std::string& reason, bool counts);
  void lose(const TaskBook::Loss& loss);
  /// It has had its turn: no more orders, and once those that are out have ended it waits again.
  void drain() { draining_ = true; }
  bool draining() const { return draining_; }
  /// To be called after what has come of orders: a drained one may now wait again.
  void settle();

  /// Nothing more is to be done: the job has ended, or waits in the queue again, or was taken away.
  bool over() const { return over_; }
  void leave() { over_ = true; }

  struct Out {
    std::uint64_t attempt = 0;
    std::optional<TaskKey> key;  ///< Nothing: on its way to Slurm.
  };
  const std::vector<Out>& out() const { return out_; }
  bool has_out(const TaskKey& key) const;

 private:
  enum class Stage { planning, rendering, concluding };
  using Clock = std::chrono::steady_clock;

  v1::BatchOrder order(std::uint64_t attempt) const;
  std::vector<Out>::iterator find(std::uint64_t attempt);
  void take_plan(FoundResult result);
  bool accept_plan(const FoundResult& result);
  void put_first_tiles(FoundResult& result);
  void take_range(FoundResult result);
  void cut_ranges(double seconds_per_tile);
  double seconds_per_tile(const FoundResult& first) const;
  void picture_is_whole();
  void conclude(v1::JobDone done);
  void fail(v1::Failed::Kind kind, const std::string& reason);
  void count(std::uint64_t tiles, std::uint64_t rays);
  void add_record(const v1::BatchResult& message, std::size_t tiles);

  JobQueue::JobPtr job_;
  JobQueue& queue_;
  std::unique_ptr<AssetFolder> assets_;
  std::filesystem::path folder_;
  Options options_;
  Stage stage_ = Stage::planning;
  bool begun_to_order_ = false;
  bool wanted_ = true;  // of the stage's one order, that nobody has it
  bool over_ = false;
  bool draining_ = false;
  std::uint32_t failures_ = 0;  // of the stage's one order
  std::uint64_t attempts_ = 0;
  std::vector<Out> out_;
  std::optional<v1::Plan> plan_;
  v1::JobDone done_;          // as far as it is known
  double first_seconds_ = 0;  // that the first task rendered for
  std::optional<TileRanges> ranges_;
  Clock::time_point begun_ = Clock::now();
};

}  // namespace metamer::service
