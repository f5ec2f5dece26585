#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/service/executors/executor.h"
#include "server/service/executors/slurm/commands.h"
#include "server/service/executors/slurm/slurm_run.h"
#include "server/service/executors/slurm/spool.h"
#include "server/service/executors/slurm/task_book.h"
#include "server/service/jobs/job_queue.h"

namespace metamer::service {

/// Has Slurm render the jobs: several at a time, each by tasks that leave their results in a folder
/// which all nodes see. Slurm is not trusted to know what it was told: what should run is held
/// against what it lists, and what is missing is submitted again, under another name. Commands and
/// files are waited for by a thread of its own, one after the other.
class SlurmExecutor final : public Executor {
 public:
  struct Options {
    v1::Backend backend = v1::CPU;  ///< Whose jobs; by GL where the commands name its device.
    std::filesystem::path folder;   ///< That all nodes see, at the same path.
    std::filesystem::path store;    ///< Of assets; nodes see it likewise.
    SlurmCommands::Options commands;
    SlurmRun::Options run;
    std::uint64_t tasks = 64;  ///< With Slurm at a time.
    /// Between two looks for results, and at what Slurm lists.
    std::chrono::milliseconds look{500};
    std::chrono::milliseconds listing{2000};
    /// After something that Slurm would not do.
    std::chrono::milliseconds try_again{5000};
    /// See TaskBook.
    std::chrono::milliseconds patience{10'000};
    std::string server;  ///< What our tasks' names begin with, and nobody else's.
  };
  /// `here` is a worker of this machine, which says what the same program can do on others.
  SlurmExecutor(const asio::any_io_executor& executor, Options options, JobQueue& queue,
                Executor& here);
  ~SlurmExecutor() override;

  void start() override;
  void stop() override;
  void work() override;
  void interrupt(const Job& job) override;
  void charge_job() override;
  const v1::Capabilities& capabilities() const override { return here_.capabilities(); }
  asio::awaitable<void> wait_for_capabilities() override { return here_.wait_for_capabilities(); }
  v1::WorkerInfo info() const override;
  std::uint32_t losses() const override { return losses_; }

 private:
  using Clock = std::chrono::steady_clock;
  using RunPtr = std::shared_ptr<SlurmRun>;
  /// Jobs that have tasks at a time; the others wait in the queue, which knows whose turn it is.
  static constexpr std::size_t most_runs = 16;
  struct Survey {
    bool listed = false;
    Result<std::vector<ListedTask>> listing;
    std::vector<FoundResult> results;
  };

  /// Has `work` done by the thread, and `then` here with what it gives. What it throws, for want of
  /// memory say, is thrown here.
  template <class Work, class Then>
  void elsewhere(Work work, Then then) {
    auto tracked = asio::prefer(executor_, asio::execution::outstanding_work.tracked);
    asio::post(thread_, [this, tracked, work = std::move(work), then = std::move(then)]() mutable {
      try {
        auto result = std::make_shared<decltype(work())>(work());
        asio::post(tracked, [this, result, then = std::move(then)]() mutable {
          if (!ending_) then(std::move(*result));
        });
      } catch (...) {
        asio::post(tracked, [error = std::current_exception()] { std::rethrow_exception(error); });
      }
    });
  }
  double now() const;

  bool take_next();
  void begin_run(JobQueue::JobPtr job);
  void hand_out();
  RunPtr fairest() const;
  void submit(const RunPtr& run, std::vector<v1::BatchOrder> orders);
  void on_submitted(const RunPtr& run, const std::string& name,
                    const std::vector<std::uint64_t>& attempts, const Result<void>& result);
  void end_run(const RunPtr& run);
  void end_what_is_over();
  std::vector<std::string> names_of(const SlurmRun& run) const;
  void cancel(std::vector<std::string> names);

  void look_later();
  void look();
  void on_survey(Survey survey);
  void take(std::vector<FoundResult> results);
  void take(const std::vector<ListedTask>& listing);
  void lose(std::vector<TaskBook::Loss> losses);
  void remove_old_folders();
  void give_way();
  void say_where();
  /// `where` is one of the two below.
  void note_trouble(std::string& where, const std::string& trouble);

  asio::any_io_executor executor_;
  Options options_;
  JobQueue& queue_;
  Executor& here_;
  std::atomic<bool> ending_ = false;
  bool started_ = false;
  SlurmCommands commands_;
  TaskBook book_;
  std::vector<RunPtr> runs_;
  std::vector<std::string> strange_;  // names in the last listing that nobody here knows, sorted
  asio::steady_timer next_look_;
  bool looking_ = false, looks_later_ = false;
  /// Folders of jobs that have ended, and since when: what ends there last, still writes.
  std::vector<std::pair<std::filesystem::path, Clock::time_point>> leavings_;
  Clock::time_point next_listing_{}, next_try_{}, charged_ = Clock::now();
  // What Slurm says against tasks, and why it says nothing; empty: all is well.
  std::string refused_, unanswered_;
  std::string trouble_;  // of the two, what was told
  std::uint32_t submissions_ = 0, losses_ = 0;
  asio::thread_pool thread_{1};  // the last: it ends first
};

}  // namespace metamer::service
