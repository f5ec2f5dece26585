// Whose turn it is among the jobs of a queue, and what each is told that it waits for.

#include <gtest/gtest.h>

#include "server/service/jobs/job_queue.h"
#include "server/service/ops/folders.h"

namespace metamer::service::test {

namespace {

class QueueTurns : public testing::Test {
 protected:
  TemporaryFolder folder_ = TemporaryFolder::make().value();
  std::shared_ptr<AssetStore> store_ = AssetStore::open(folder_.path() / "store", 1000).value();
  Limits limits_;
  double now_ = 1000 * 86400;
  JobQueue queue_{1 << 20, 1, limits_, [this] { return now_; }};
  AccountPtr one_ = std::make_shared<Account>(Account{.name = "one"});
  AccountPtr other_ = std::make_shared<Account>(Account{.name = "other"});

  JobQueue::JobPtr submit(const AccountPtr& owner, std::int32_t priority = 0,
                          v1::Backend backend = v1::CPU) {
    v1::Submit submit;
    submit.set_priority(priority);
    submit.set_backend(backend);
    return queue_.submit(std::move(submit), AssetHolds(*store_), owner).value();
  }
  /// The next job, which takes so many seconds and is done with.
  JobQueue::JobPtr serve(double seconds) {
    JobQueue::JobPtr job = queue_.next(v1::CPU);
    if (!job) return job;
    job->start();
    queue_.spend(*job, seconds);
    job->fail(v1::Failed::SERVER, "enough");
    queue_.ended(*job);
    return job;
  }
  std::string reason(const JobQueue::JobPtr& job) { return queue_.summary(*job).reason(); }
};

}  // namespace

TEST_F(QueueTurns, SecondsCountAndNotJobs) {
  submit(one_);
  for (int i = 0; i < 6; ++i) submit(other_);
  const auto later = submit(one_);
  EXPECT_EQ(serve(5)->owner(), one_);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(serve(1.1)->owner(), other_) << i;
  EXPECT_EQ(serve(1), later);
}

TEST_F(QueueTurns, BackendsAreSharedEachByItself) {
  submit(one_);
  const auto by_gl = submit(one_, 0, v1::GL);
  EXPECT_EQ(serve(1000)->owner(), one_);
  submit(other_, 0, v1::GL);
  EXPECT_EQ(queue_.next(v1::GL), by_gl);  // what the CPU did for its user does not count
}

TEST_F(QueueTurns, AJobGivesWayOnceAnotherUserHasHadLess) {
  submit(one_);
  const auto job = queue_.next(v1::CPU);
  job->start();
  queue_.spend(*job, 100);
  EXPECT_FALSE(queue_.gives_way(*job));
  submit(one_);
  EXPECT_FALSE(queue_.gives_way(*job));
  submit(one_, 1);
  EXPECT_TRUE(queue_.gives_way(*job));
}

TEST_F(QueueTurns, WhoComesWhileAnotherHasTheWorkerIsNext) {
  submit(one_);
  const auto job = queue_.next(v1::CPU);
  job->start();
  queue_.spend(*job, 2);
  const auto rival = submit(other_);
  EXPECT_TRUE(queue_.gives_way(*job));
  ASSERT_TRUE(job->yield("others have their turn", 1));
  queue_.put_back(job);
  EXPECT_EQ(queue_.next(v1::CPU), rival);
}

TEST_F(QueueTurns, EachIsToldWhatItWaitsFor) {
  const auto first = submit(one_);
  EXPECT_EQ(reason(first), "");
  queue_.next(v1::CPU)->start();
  EXPECT_EQ(reason(first), "");
  const auto second = submit(one_);
  const auto third = submit(one_);
  EXPECT_EQ(reason(second), "1 job of the same user comes before it");
  EXPECT_EQ(reason(third), "2 jobs of the same user come before it");
  ASSERT_TRUE(queue_.prioritize(*third, 1));
  EXPECT_EQ(reason(third), "1 job of the same user comes before it");
  EXPECT_EQ(reason(second), "2 jobs of the same user come before it");
  const auto stranger = submit(other_);
  EXPECT_EQ(reason(stranger), "1 other user has turns");
  EXPECT_EQ(reason(second), "2 jobs of the same user come before it; 1 other user has turns");
  EXPECT_EQ(reason(submit(other_, 0, v1::GL)), "");
  ASSERT_TRUE(queue_.pause(*second));
  EXPECT_EQ(reason(second), "");
  queue_.hold(v1::CPU, "no worker starts: exited with code 3");
  EXPECT_EQ(reason(stranger), "no worker starts: exited with code 3");
  queue_.hold(v1::CPU, "");
  EXPECT_EQ(reason(stranger), "1 other user has turns");
}

TEST_F(QueueTurns, WhoHasHadItsWorkOfTheDayWaitsAndOthersDoNot) {
  limits_.user_work = 100;
  submit(one_);
  EXPECT_EQ(serve(99)->owner(), one_);
  const auto last = submit(one_);
  const auto held = submit(one_);
  EXPECT_EQ(serve(50), last) << "it has begun within its quota";
  EXPECT_EQ(queue_.next(v1::CPU), nullptr);
  EXPECT_EQ(reason(held),
            "one has had 149 of 100 s of workers within a day; goes on at 1972-09-28 00:00 UTC");
  const auto others = submit(other_);
  EXPECT_EQ(serve(1), others);

  now_ += 86399;
  EXPECT_EQ(queue_.next(v1::CPU), nullptr);
  now_ += 1;
  EXPECT_EQ(queue_.next(v1::CPU), held);
  held->start();
  EXPECT_FALSE(queue_.gives_way(*held));
  queue_.spend(*held, 100);
  EXPECT_TRUE(queue_.gives_way(*held)) << "though nobody else waits";
}

TEST_F(QueueTurns, AWorkOfOnesOwnGoesBeforeThatOfAllAndAdminsHaveNone) {
  limits_.user_work = 10;
  one_->max_work = 0;
  other_->admin = true;
  for (const AccountPtr& user : {one_, other_}) {
    submit(user);
    submit(user);
    EXPECT_NE(serve(1000), nullptr);
    EXPECT_NE(serve(1000), nullptr);
  }
  one_->max_work = 3000;
  other_->admin = false;
  const auto allowed = submit(one_);
  submit(other_);
  EXPECT_EQ(serve(1), allowed);
  EXPECT_EQ(queue_.next(v1::CPU), nullptr);
  limits_.user_work = 0;
  EXPECT_NE(queue_.next(v1::CPU), nullptr) << "as SIGHUP changes it";
}

}  // namespace metamer::service::test
