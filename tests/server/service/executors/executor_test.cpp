// The port through which jobs are rendered: another implementation of it than that of the workers
// of this machine makes the same picture of a job, in whatever order and how often its ranges come.

#include "server/service/executors/executor.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "rendered_range.h"
#include "server/service/executors/supervisor.h"
#include "server/service/jobs/job_queue.h"
#include "server/service/ops/folders.h"

namespace metamer::service::test {

namespace {

/// Draws in this process, when it is told: the last range first, each twice, one with a flipped
/// byte and one not at all at the first try.
class Disorderly : public Executor {
 public:
  explicit Disorderly(JobQueue& queue) : queue_(queue) {}

  void start() override {}
  void stop() override { job_.reset(); }
  void work() override {
    if (!job_) job_ = queue_.next(v1::CPU);
  }
  void interrupt(const Job& job) override {
    if (job_.get() == &job) job_.reset();
  }
  void charge_job() override {
    if (job_) queue_.spend(*job_, 1);
  }
  const v1::Capabilities& capabilities() const override { return capabilities_; }
  asio::awaitable<void> wait_for_capabilities() override { co_return; }
  v1::WorkerInfo info() const override { return {}; }
  std::uint32_t losses() const override { return losses_; }

  /// Renders its job by a plan.
  void render_job(const v1::Plan& plan) {
    job_->start();
    ASSERT_TRUE(job_->plan(plan));
    ASSERT_TRUE(job_->make_film());
    TileRanges ranges(*job_, attempts_, 5);
    render_once(ranges, true);
    render_once(ranges, false);
    ASSERT_TRUE(ranges.complete());
    job_->finish({});
    queue_.ended(*job_);
    job_.reset();
  }
  int counted() const { return counted_; }
  int refused() const { return refused_; }

 private:
  void render_once(TileRanges& ranges, bool first) {
    std::vector<RangeOrder> orders;
    while (const auto order = ranges.hand_out()) orders.push_back(*order);
    std::reverse(orders.begin(), orders.end());
    if (first) {
      ranges.lose(orders[0].attempt);
      ++losses_;
      RangeResult flipped = render(orders[1], job_->tiles());
      flipped.tiles.back().xyz.back() ^= 1;
      refused_ += ranges.take(flipped) == TileRanges::Verdict::damaged;
      orders.erase(orders.begin(), orders.begin() + 2);
    }
    for (const RangeOrder& order : orders) {
      const auto again = ranges.hand_out_again(order.attempt);
      ASSERT_TRUE(again);
      for (const RangeOrder& one : {*again, order})
        counted_ += ranges.take(render(one, job_->tiles())) == TileRanges::Verdict::counts;
    }
  }

  JobQueue& queue_;
  JobQueue::JobPtr job_;
  v1::Capabilities capabilities_;
  std::uint64_t attempts_ = 0;
  std::uint32_t losses_ = 0;
  int counted_ = 0, refused_ = 0;
};

class ExecutorPort : public testing::Test {
 protected:
  TemporaryFolder folder_ = TemporaryFolder::make().value();
  std::shared_ptr<AssetStore> store_ = AssetStore::open(folder_.path() / "store", 1 << 20).value();
  JobQueue queue_{1 << 30, 1};

  /// A job whose scene the fake worker reads.
  JobQueue::JobPtr submit(const std::string& script) {
    const Digest digest = sha256(script);
    auto upload = AssetUpload::begin(*store_, {}, digest, script.size());
    EXPECT_TRUE(upload && upload->add(0, script) && upload->commit());
    AssetHolds holds(*store_);
    EXPECT_TRUE(holds.add(digest));
    v1::Submit message;
    message.set_scene_sha256(std::string(to_bytes(digest)));
    return queue_.submit(std::move(message), std::move(holds)).value();
  }

  /// As the worker of this machine renders it.
  void render_here(const JobQueue::JobPtr& job) {
    asio::io_context context;
    Views views{default_limits};
    Supervisor::Options options;
    options.command.program = METAMER_BIN "/metamer-fake-worker";
    options.command.store = folder_.path() / "store";
    Supervisor supervisor(context.get_executor(), options, queue_, views);
    Executor& executor = supervisor;
    executor.work();
    while (!job->ended() && context.run_one() > 0) continue;
    executor.stop();
  }

  static std::string picture(const Job& job) {
    return std::string(reinterpret_cast<const char*>(const_cast<Job&>(job).film().at(0, 0)),
                       job.film_bytes());
  }
};

}  // namespace

TEST_F(ExecutorPort, AnotherMakesTheSamePictureBitForBitAndCountsEachRangeOnce) {
  const std::string script = "picture 200 136 16";
  const auto here = submit(script);
  render_here(here);
  ASSERT_EQ(here->state(), v1::FINISHED);

  const auto there = submit(script);
  Disorderly executor(queue_);
  executor.work();
  v1::Plan plan;
  plan.set_width(200);
  plan.set_height(136);
  plan.set_tile_size(16);
  executor.render_job(plan);
  ASSERT_EQ(there->state(), v1::FINISHED);
  EXPECT_EQ(picture(*there), picture(*here));

  // 117 tiles in 24 ranges, of which one was lost and one damaged before.
  EXPECT_EQ(executor.counted(), 24);
  EXPECT_EQ(executor.refused(), 1);
  EXPECT_EQ(executor.losses(), 1u);
  EXPECT_EQ(there->tiles_done(), 117u);
  // Each tile once in the log, too: what a watcher is told.
  int tiles = 0;
  for (std::uint64_t from = 1;;) {
    const auto entry = there->log().next(from, {.tiles = true});
    if (!entry || entry->sequence < from) break;
    tiles += there->event(*entry, false).value().has_tile();
    from = entry->sequence + 1;
  }
  EXPECT_EQ(tiles, 117);
}

}  // namespace metamer::service::test
