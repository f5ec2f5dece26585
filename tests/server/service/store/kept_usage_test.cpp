// What users have had of the workers, over the end of a daemon, however it comes.
#include <gtest/gtest.h>

#include "../temporary_state.h"
#include "server/service/jobs/job_queue.h"
#include "server/service/ops/folders.h"

namespace metamer::service::test {
namespace {

/// A queue that is kept, without sockets and workers: what ends it forgets all that was not asked
/// to be kept, as a crash does.
class KeptUsage : public testing::Test {
 protected:
  struct Running {
    boost::asio::io_context loop;
    std::shared_ptr<AssetStore> assets;
    std::unique_ptr<JobStore> store;
    JobQueue queue;
    explicit Running(const Limits& limits, WallClock clock)
        : queue(1 << 20, 1, limits, std::move(clock)) {}
  };
  TemporaryState state_;
  Limits limits_;
  double now_ = 1000 * 86400 + 1800;
  std::unique_ptr<Running> running_;
  AccountPtr one_ = std::make_shared<Account>(Account{.name = "one"});
  AccountPtr other_ = std::make_shared<Account>(Account{.name = "other"});

  JobQueue& queue() { return running_->queue; }

  void start() {
    running_.reset();
    running_ = std::make_unique<Running>(limits_, [this] { return now_; });
    running_->assets = AssetStore::open(state_.path() / "assets", 1000).value();
    running_->store = JobStore::open(running_->loop.get_executor(), state_.path()).value();
    queue().keep_in(*running_->store, "");
    for (JobStore::Kept& kept : running_->store->take_kept()) {
      const auto job = std::make_shared<Job>(*std::move(kept.record), AssetHolds(*running_->assets),
                                             kept.user == "one" ? one_ : other_, *running_->store);
      if (!job->ended()) job->go_on("", 0);
      queue().restore(job);
    }
    queue().restore(running_->store->take_leads(), running_->store->take_work());
  }
  void SetUp() override { start(); }

  std::uint64_t submit(const AccountPtr& owner) {
    return queue().submit({}, AssetHolds(*running_->assets), owner).value()->id();
  }
  JobQueue::JobPtr begin(std::uint64_t id) {
    const JobQueue::JobPtr job = queue().next(v1::CPU);
    EXPECT_EQ(job->id(), id);
    job->start();
    return job;
  }
  double seconds(std::uint64_t id) { return queue().find(id)->worker_seconds(); }
};

}  // namespace

TEST_F(KeptUsage, ARestartInTheMiddleDoesNotFavourWhoHasHadMore) {
  const std::uint64_t greedy = submit(one_);
  const auto running = begin(greedy);
  const std::uint64_t modest = submit(other_);
  queue().spend(*running, 20);
  start();
  // The same number of seconds is due to the other one first, in however many turns.
  for (int turn = 0; turn < 5; ++turn) {
    const auto job = begin(modest);
    queue().spend(*job, 3.9);
    EXPECT_EQ(queue().gives_way(*job), false) << turn;
    start();
  }
  const auto job = begin(modest);
  queue().spend(*job, 3.9);
  EXPECT_TRUE(queue().gives_way(*job));
}

TEST_F(KeptUsage, WhoHasHadMoreAndGoneIsKnownWhenHeComesBack) {
  const std::uint64_t first = submit(one_);
  const std::uint64_t waiting = submit(other_);
  const auto running = begin(first);
  queue().spend(*running, 20);
  running->fail(v1::Failed::SERVER, "enough");
  queue().ended(*running);
  start();
  submit(one_);
  const auto job = begin(waiting);
  queue().spend(*job, 15);
  EXPECT_FALSE(queue().gives_way(*job));
}

TEST_F(KeptUsage, AJobKeepsWhatWorkersSpentOnItThoughNothingElseHappens) {
  const std::uint64_t id = submit(one_);
  auto job = begin(id);
  queue().spend(*job, most_unkept_seconds - 1);
  queue().spend(*job, 2);
  const double known = seconds(id);
  queue().spend(*job, 1);
  start();
  EXPECT_EQ(seconds(id), known);
  job = begin(id);
  queue().spend(*job, 3);
  ASSERT_TRUE(job->pause());
  start();
  EXPECT_EQ(seconds(id), known + 3);
}

TEST_F(KeptUsage, ARestartGivesNobodyANewDaysWork) {
  limits_.user_work = 100;
  auto job = begin(submit(one_));
  queue().spend(*job, 60);
  start();
  now_ += 3600;
  job = begin(job->id());
  queue().spend(*job, 50);
  start();
  EXPECT_EQ(queue().next(v1::CPU), nullptr);
  EXPECT_EQ(queue().work_text(*queue().find(job->id())),
            "one has had 110 of 100 s of workers within a day; goes on at 1972-09-28 00:00 UTC");
  now_ += 23 * 3600;
  EXPECT_NE(queue().next(v1::CPU), nullptr);
}

}  // namespace metamer::service::test
