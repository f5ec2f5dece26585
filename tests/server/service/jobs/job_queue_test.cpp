// The queue: numbers, order, what is kept and what is refused.
#include "server/service/jobs/job_queue.h"

#include <cstdint>
#include <limits>
#include <map>

#include "common/wire/frame.h"
#include "job_fixture.h"
#include "server/service/limits.h"
#include "server/service/net/watches.h"

namespace metamer::service {

namespace {

class JobQueueTest : public JobTest {};

}  // namespace

TEST_F(JobQueueTest, JobsAreNumberedFromTheClockInWhatJsonKeeps) {
  using std::chrono::sys_days;
  using namespace std::chrono_literals;
  const std::chrono::system_clock::time_point day = sys_days(2026y / 11 / 26);
  EXPECT_EQ(clock_job_id(day), 1'795'651'200'000'001u);
  EXPECT_EQ(clock_job_id(day + 1us), clock_job_id(day) + 1);
  for (const auto now : {sys_days(1969y / 12 / 31), sys_days(1970y / 1 / 1),
                         sys_days(2112y / 12 / 31), sys_days(2250y / 1 / 1)}) {
    EXPECT_GE(clock_job_id(now), 1u);
    EXPECT_LE(clock_job_id(now), std::uint64_t{1} << 52);
  }
  JobQueue queue(1 << 20, clock_job_id(day));
  EXPECT_EQ(queue.submit({}, AssetHolds(*store_)).value()->id(), clock_job_id(day));
  EXPECT_EQ(queue.submit({}, AssetHolds(*store_)).value()->id(), clock_job_id(day) + 1);
}

TEST_F(JobQueueTest, OneUsersJobsAreServedAsTheyCameAndKeepTheirPlaces) {
  JobQueue queue(1 << 20, 1);
  const auto first = queue.submit({}, AssetHolds(*store_)).value();
  const auto second = queue.submit({}, AssetHolds(*store_)).value();
  const auto third = queue.submit({}, AssetHolds(*store_)).value();
  ASSERT_EQ(queue.next(v1::CPU), first);
  first->start();
  ASSERT_TRUE(queue.pause(*second));
  ASSERT_TRUE(queue.resume(second));
  first->retry("lost");
  queue.put_back(first);
  EXPECT_EQ(queue.next(v1::CPU), first);
  EXPECT_EQ(queue.next(v1::CPU), second);
  EXPECT_EQ(queue.next(v1::CPU), third);
  EXPECT_EQ(queue.next(v1::CPU), nullptr);
}

TEST_F(JobQueueTest, EachBackendGetsItsOwnJobsInTheirOrder) {
  JobQueue queue(1 << 20, 1);
  v1::Submit by_gl;
  by_gl.set_backend(v1::GL);
  const auto first = queue.submit({}, AssetHolds(*store_)).value();
  EXPECT_FALSE(queue.has_work(v1::GL));
  const auto second = queue.submit(by_gl, AssetHolds(*store_)).value();
  const auto third = queue.submit({}, AssetHolds(*store_)).value();
  EXPECT_TRUE(queue.has_work(v1::GL));
  EXPECT_EQ(queue.next(v1::GL), second);
  EXPECT_FALSE(queue.has_work(v1::GL));
  EXPECT_EQ(queue.next(v1::GL), nullptr);
  EXPECT_EQ(queue.next(v1::CPU), first);
  EXPECT_EQ(queue.next(v1::CPU), third);
}

TEST_F(JobQueueTest, AFullQueueRefusesUntilAJobEnds) {
  JobQueue queue(1 << 20, 1);
  for (std::size_t i = 0; i < max_live_jobs; ++i) {
    ASSERT_TRUE(queue.submit({}, AssetHolds(*store_)));
  }
  const auto refused = queue.submit({}, AssetHolds(*store_));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, v1::Error::LIMIT);
  EXPECT_EQ(refused.error().message, "the queue is full: 256 jobs have not ended");
  ASSERT_TRUE(queue.cancel(*queue.find(1)));
  EXPECT_TRUE(queue.submit({}, AssetHolds(*store_)));
}

TEST_F(JobQueueTest, EndedJobsAreDroppedOldestFirstWhenTheirPicturesTakeTooMuch) {
  JobQueue queue(13'000, 1);  // two pictures of 32 × 16 × 12 bytes
  for (std::uint64_t id = 1; id <= 3; ++id) {
    queue.submit({}, AssetHolds(*store_)).value();
    const auto job = queue.next(v1::CPU);
    job->start();
    ASSERT_TRUE(job->plan(plan(32, 16, 16)));
    ASSERT_TRUE(job->make_film());
    job->finish({});
    queue.ended(*job);
  }
  EXPECT_EQ(queue.find(1), nullptr);
  EXPECT_NE(queue.find(2), nullptr);
  EXPECT_NE(queue.find(3), nullptr);
}

TEST_F(JobQueueTest, PicturesThatAreOnlyWatchedTakeNoMoreMemoryThanIsKept) {
  constexpr std::uint64_t kept = 13'000;  // two pictures of 32 × 16 × 12 bytes
  JobQueue queue(kept, 1);
  std::vector<std::shared_ptr<Job>> jobs;
  Watches watches([] {});
  v1::Watch watch;
  watch.set_tiles(true);
  for (std::uint64_t id = 1; id <= 10; ++id) {
    jobs.push_back(queue.submit({}, AssetHolds(*store_)).value());
    Job& job = *queue.next(v1::CPU);
    watches.add(id, watch, jobs.back());
    job.start();
    ASSERT_TRUE(job.plan(plan(32, 16, 16)));
    ASSERT_TRUE(job.make_film());
    job.add_tile(0, 1);
    job.add_tile(1, 1);
    job.finish({});
    queue.ended(job);
    std::uint64_t bytes = 0;
    for (const auto& each : jobs) bytes += each->film_bytes();
    EXPECT_LE(bytes, 2 * kept) << id;
  }
  // Who reads then gets a picture whole, or is told.
  std::map<std::uint64_t, int> tiles;
  std::map<std::uint64_t, std::string> ends;
  while (const auto message = watches.next()) {
    const std::uint64_t id = message->request_id();
    tiles[id] += message->job_event().has_tile();
    if (message->job_event().has_finished()) ends[id] = "finished";
    if (message->has_error()) ends[id] = message->error().message();
  }
  EXPECT_EQ(watches.size(), 0u);
  for (std::uint64_t id = 1; id <= 10; ++id) {
    const bool whole = id > 6;
    EXPECT_EQ(tiles[id], whole ? 2 : 0) << id;
    EXPECT_EQ(ends[id], whole ? "finished"
                              : "the picture of job " + std::to_string(id) +
                                    " was dropped before it was read");
  }
}

TEST_F(JobQueueTest, OwnersHaveTurnsAndLeaveRoomForEachOther) {
  JobQueue queue(1 << 20, 1);
  const auto greedy = std::make_shared<Account>(Account{.name = "uid 1000"});
  const auto other = std::make_shared<Account>(Account{.name = "10.0.0.2"});
  std::vector<JobQueue::JobPtr> many;
  while (const auto job = queue.submit({}, AssetHolds(*store_), greedy)) many.push_back(*job);
  EXPECT_EQ(many.size(), max_live_jobs / 8 * 7);
  EXPECT_EQ(queue.submit({}, AssetHolds(*store_), greedy).error().message,
            "uid 1000 has its share of the queue: 224 of its jobs have not ended");
  const auto first = queue.submit({}, AssetHolds(*store_), other);
  const auto second = queue.submit({}, AssetHolds(*store_), other);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(queue.next(v1::CPU), many[0]);
  EXPECT_EQ(queue.next(v1::CPU), *first);
  EXPECT_EQ(queue.next(v1::CPU), many[1]);
  EXPECT_EQ(queue.next(v1::CPU), *second);
  EXPECT_EQ(queue.next(v1::CPU), many[2]);
  EXPECT_EQ(queue.next(v1::CPU), many[3]);
}

TEST_F(JobQueueTest, ALongListComesInControlMessages) {
  Limits limits;
  limits.live_jobs = limits.ended_jobs = 2000;
  JobQueue queue(1 << 20, 1, limits);
  v1::Submit submit;
  submit.set_name(std::string(max_job_name, 'x'));
  for (std::size_t i = 0; i < 3000; ++i) {
    queue.submit(submit, AssetHolds(*store_)).value();
    if (i % 3 == 0) continue;
    const auto job = queue.next(v1::CPU);
    v1::Failed failed;
    failed.set_reason(std::string(5000, 'x'));
    job->fail(failed);
    queue.ended(*job);
  }
  const auto all = [](const Job&) { return true; };
  std::uint64_t last = 0;
  std::size_t count = 0;
  for (bool more = true; more;) {
    const v1::JobList list = queue.list(last, all);
    EXPECT_LE(list.ByteSizeLong() + 32, wire::max_control_frame);
    for (const v1::JobSummary& job : list.job()) {
      EXPECT_GT(job.job_id(), last);
      last = job.job_id();
      ++count;
    }
    more = list.more();
  }
  EXPECT_EQ(count, 3000u);
  EXPECT_EQ(queue.list(last - 1, all).job_size(), 1);
  EXPECT_EQ(queue.list(0, [](const Job& job) { return job.id() == 7; }).job(0).job_id(), 7u);
}

TEST_F(JobQueueTest, LaterJobsOfASeriesHaveThePriorityThatItWasGiven) {
  JobQueue queue(1 << 20, 1);
  v1::Submit submit;
  submit.mutable_series()->set_id(std::string(series_id_bytes, 's'));
  const auto first = queue.submit(submit, AssetHolds(*store_)).value();
  ASSERT_TRUE(queue.prioritize(*first, 7));
  const auto second = queue.submit(submit, AssetHolds(*store_)).value();
  EXPECT_EQ(second->summary().priority(), 7);
  submit.set_priority(-3);
  EXPECT_EQ(queue.submit(submit, AssetHolds(*store_)).value()->summary().priority(), -3);
  const auto other = std::make_shared<Account>(Account{.name = "uid 1000"});
  submit.set_priority(0);
  EXPECT_EQ(queue.submit(submit, AssetHolds(*store_), other).value()->summary().priority(), 0);
  EXPECT_EQ(queue.submit({}, AssetHolds(*store_)).value()->summary().priority(), 0);
}

TEST_F(JobQueueTest, PrioritiesBeyondTheirRangeAreRefused) {
  JobQueue queue(1 << 20, 1);
  const auto job = queue.submit(v1::Submit(), AssetHolds(*store_)).value();
  for (const std::int32_t good : {-100, 0, 100}) {
    ASSERT_TRUE(queue.prioritize(*job, good));
    EXPECT_EQ(job->summary().priority(), good);
  }
  for (const std::int32_t bad : {std::numeric_limits<std::int32_t>::min(), -101, 101,
                                 std::numeric_limits<std::int32_t>::max()}) {
    const auto refused = queue.prioritize(*job, bad);
    ASSERT_FALSE(refused) << bad;
    EXPECT_EQ(refused.error().code, v1::Error::LIMIT);
    v1::Submit submit;
    submit.set_priority(bad);
    EXPECT_FALSE(queue.submit(submit, AssetHolds(*store_))) << bad;
  }
  EXPECT_EQ(job->summary().priority(), 100);
}

}  // namespace metamer::service
