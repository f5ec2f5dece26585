// A job by itself, without workers and sockets.

#include "server/service/job.h"

#include <gtest/gtest.h>

#include <map>

#include "server/service/folders.h"
#include "server/service/job_queue.h"
#include "server/service/limits.h"
#include "server/service/watches.h"

namespace metamer::service {

namespace {

class JobTest : public testing::Test {
 protected:
  TemporaryFolder folder_ = TemporaryFolder::make().value();
  std::shared_ptr<AssetStore> store_ = AssetStore::open(folder_.path() / "store", 1000).value();

  static v1::Plan plan(std::uint32_t width, std::uint32_t height, std::uint32_t tile) {
    v1::Plan plan;
    plan.set_width(width);
    plan.set_height(height);
    plan.set_tile_size(tile);
    return plan;
  }
  std::shared_ptr<Job> make_job() {
    return std::make_shared<Job>(7, v1::Submit(), AssetHolds(*store_), 0);
  }
  std::shared_ptr<Job> running_job() {
    auto job = make_job();
    EXPECT_TRUE(job->start());
    EXPECT_TRUE(job->plan(plan(32, 16, 16)));
    EXPECT_TRUE(job->make_film());
    return job;
  }
  static std::vector<v1::JobEvent> read(const Job& job, EventLog::Filter filter,
                                        std::uint64_t from = 1) {
    std::vector<v1::JobEvent> events;
    while (const auto entry = job.log().next(from, filter)) {
      if (!events.empty() && entry->sequence <= events.back().sequence()) break;
      events.push_back(job.event(*entry, false));
      from = entry->sequence + 1;
    }
    return events;
  }
};

}  // namespace

TEST_F(JobTest, AStepThatTheStateForbidsChangesNothing) {
  auto job = make_job();
  const auto before = job->log().last_sequence();
  EXPECT_FALSE(job->resume(0));
  EXPECT_FALSE(job->finish({}));
  EXPECT_FALSE(job->retry("lost"));
  EXPECT_EQ(job->state(), v1::QUEUED);
  EXPECT_EQ(job->log().last_sequence(), before);
}

TEST_F(JobTest, AWorkerMayBeLostOnceAndNotTwice) {
  auto job = running_job();
  EXPECT_TRUE(job->retry("killed by signal 9 (Killed)"));
  EXPECT_EQ(job->state(), v1::QUEUED);
  EXPECT_TRUE(job->start());
  EXPECT_FALSE(job->retry("killed by signal 9 (Killed)"));
  EXPECT_EQ(job->state(), v1::RUNNING);
  const auto events = read(*job, {});
  EXPECT_EQ(events.back().started().attempt(), 2u);
}

TEST_F(JobTest, ARestartDropsTheTilesAndTellsItsNewPlanOnce) {
  auto job = running_job();
  job->add_tile(0, 5);
  v1::Method better;
  better.mutable_exact();
  ASSERT_TRUE(job->restart("the promise was broken", better));
  EXPECT_EQ(job->tiles_done(), 0u);
  EXPECT_TRUE(job->method()->has_exact());
  const auto planned = [&] {
    const auto events = read(*job, {});
    return std::count_if(events.begin(), events.end(),
                         [](const v1::JobEvent& event) { return event.has_planned(); });
  };

  // Pausing keeps the new tiles: another plan would make its watchers drop them.
  job->start();
  ASSERT_TRUE(job->plan(plan(32, 16, 16)));
  EXPECT_EQ(planned(), 2);
  ASSERT_TRUE(job->make_film());
  job->add_tile(0, 5);
  job->pause();
  job->resume(0);
  job->start();
  ASSERT_TRUE(job->plan(plan(32, 16, 16)));
  EXPECT_EQ(planned(), 2);
  EXPECT_EQ(job->missing_tiles(10), std::vector<std::uint32_t>{1});
  EXPECT_FALSE(job->restart("broken again", better));
}

TEST_F(JobTest, ACheckOfThePictureHasItsOwnProgressAndNoPartInTheRenderTime) {
  auto job = make_job();
  job->start();
  v1::Plan checked = plan(32, 16, 16);
  checked.set_verify_cost(3);
  ASSERT_TRUE(job->plan(checked));
  EXPECT_TRUE(job->verifies());
  ASSERT_TRUE(job->make_film());
  job->add_tile(0, 5);
  job->add_tile(1, 5);
  job->add_verified(1);
  v1::Progress progress;
  for (const v1::JobEvent& event : read(*job, {}))
    if (event.has_progress()) progress = event.progress();
  EXPECT_EQ(progress.tiles_done(), 2u);
  EXPECT_EQ(progress.tiles_verified(), 1u);

  v1::JobDone done;
  done.mutable_timing()->set_verify(1e6);
  done.mutable_accuracy()->mutable_error()->set_share(1);
  ASSERT_TRUE(job->finish(done));
  const v1::Finished finished = read(*job, {}).back().finished();
  EXPECT_EQ(finished.timing().render(), 0);
  EXPECT_EQ(finished.timing().verify(), 1e6);
  EXPECT_EQ(finished.accuracy().error().share(), 1);
}

TEST_F(JobTest, PlansBeyondTheLimitsAreRefusedBeforeMemoryIsTaken) {
  auto job = make_job();
  job->start();
  EXPECT_EQ(job->plan(plan(0, 16, 16)).error().message, "a picture of 0 x 16 pixels");
  EXPECT_EQ(job->plan(plan(16385, 1, 16)).error().message, "a picture of 16385 x 1 pixels");
  EXPECT_EQ(job->plan(plan(16384, 16385, 16)).error().message, "a picture of 16384 x 16385 pixels");
  EXPECT_EQ(job->plan(plan(65536, 65536, 16)).error().message, "a picture of 65536 x 65536 pixels");
  EXPECT_EQ(job->plan(plan(16, 16, 0)).error().message, "tiles of 0 pixels");
  EXPECT_EQ(job->plan(plan(16, 16, 12)).error().message, "tiles of 12 pixels");
  EXPECT_EQ(job->plan(plan(16, 16, 264)).error().message, "tiles of 264 pixels");
  EXPECT_FALSE(job->planned());
  EXPECT_TRUE(job->plan(plan(16384, 4096, 8)));
  EXPECT_EQ(job->film_bytes(), 0u);
}

TEST_F(JobTest, AnotherAttemptMayNotPlanAnotherPicture) {
  auto job = running_job();
  job->retry("lost");
  job->start();
  EXPECT_EQ(job->plan(plan(32, 32, 16)).error().message, "another picture than the attempt before");
  EXPECT_TRUE(job->plan(plan(32, 16, 16)));
}

TEST_F(JobTest, TilesOutliveALostWorkerAndAPause) {
  auto job = running_job();
  job->add_tile(0, 5);
  EXPECT_EQ(job->missing_tiles(10), std::vector<std::uint32_t>{1});
  job->retry("lost");
  job->start();
  ASSERT_TRUE(job->plan(plan(32, 16, 16)));
  ASSERT_TRUE(job->make_film());
  EXPECT_EQ(job->missing_tiles(10), std::vector<std::uint32_t>{1});
  job->pause();
  job->resume(0);
  EXPECT_EQ(job->missing_tiles(10), std::vector<std::uint32_t>{1});
  EXPECT_EQ(job->summary().tiles_done(), 1u);
}

TEST_F(JobTest, CancellingDropsThePictureAndKeepsTheNumbers) {
  auto job = running_job();
  job->add_tile(0, 5);
  EXPECT_GT(job->film_bytes(), 0u);
  const auto before = job->log().last_sequence();
  EXPECT_TRUE(job->cancel());
  EXPECT_EQ(job->film_bytes(), 0u);
  const auto events = read(*job, {.tiles = true, .previews = true});
  EXPECT_EQ(events.size(), 4u);  // queued, started, planned, cancelled
  EXPECT_TRUE(events.back().has_cancelled());
  EXPECT_EQ(events.back().sequence(), before + 1);
}

TEST_F(JobTest, AReaderMayBeginAnywhereAndLeaveTilesOut) {
  auto job = running_job();
  job->add_tile(0, 5);
  job->add_tile(1, 5);
  job->finish({});
  EXPECT_EQ(read(*job, {.tiles = true}, 4).front().tile().x(), 0u);
  for (const auto& event : read(*job, {})) EXPECT_FALSE(event.has_tile());
  // Who asks for more than there is gets the end, not silence.
  const auto beyond = read(*job, {.tiles = true}, 1000);
  ASSERT_EQ(beyond.size(), 1u);
  EXPECT_TRUE(beyond[0].has_finished());
}

TEST_F(JobTest, OnlyTheNewestProgressIsKept) {
  auto job = make_job();
  job->start();
  ASSERT_TRUE(job->plan(plan(64, 64, 8)));
  ASSERT_TRUE(job->make_film());
  for (std::uint32_t i = 0; i < 64; ++i) job->add_tile(i, 1);
  int progress = 0;
  for (const auto& event : read(*job, {.tiles = true})) {
    if (!event.has_progress()) continue;
    ++progress;
    EXPECT_EQ(event.progress().tiles_done(), 64u);
    EXPECT_EQ(event.progress().rays(), 64u);
    EXPECT_EQ(event.progress().seconds_left(), 0);
  }
  EXPECT_EQ(progress, 1);
}

TEST_F(JobTest, PreviewsAreMadeOnlyWhileSomebodyWantsThem) {
  auto job = running_job();
  job->add_tile(0, 1);
  EXPECT_EQ(read(*job, {.previews = true}).back().preview().rgb().size(), 0u);
  int woken = 0;
  {
    const Job::Watcher watcher(job, true, [&] { ++woken; });
    job->add_tile(1, 1);
  }
  EXPECT_EQ(woken, 1);
  bool seen = false;
  for (const auto& event : read(*job, {.previews = true})) seen = seen || event.has_preview();
  EXPECT_TRUE(seen);
  for (const auto& event : read(*job, {})) EXPECT_FALSE(event.has_preview());
}

TEST_F(JobTest, JobsAreNumberedFromTheClockInWhatJsonKeeps) {
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

TEST_F(JobTest, TheQueueIsFirstComeFirstServedAndARetriedJobComesBeforeAll) {
  JobQueue queue(1 << 20, 1);
  const auto first = queue.submit({}, AssetHolds(*store_)).value();
  const auto second = queue.submit({}, AssetHolds(*store_)).value();
  const auto third = queue.submit({}, AssetHolds(*store_)).value();
  ASSERT_EQ(queue.next(v1::CPU), first);
  first->start();
  ASSERT_TRUE(queue.pause(*second));
  ASSERT_TRUE(queue.resume(second));
  first->retry("lost");
  queue.put_first(first);
  EXPECT_EQ(queue.next(v1::CPU), first);
  EXPECT_EQ(queue.next(v1::CPU), third);
  EXPECT_EQ(queue.next(v1::CPU), second);
  EXPECT_EQ(queue.next(v1::CPU), nullptr);
}

TEST_F(JobTest, EachBackendGetsItsOwnJobsInTheirOrder) {
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

TEST_F(JobTest, AFullQueueRefusesUntilAJobEnds) {
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

TEST_F(JobTest, EndedJobsAreDroppedOldestFirstWhenTheirPicturesTakeTooMuch) {
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

TEST_F(JobTest, PicturesThatAreOnlyWatchedTakeNoMoreMemoryThanIsKept) {
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

TEST_F(JobTest, OwnersHaveTurnsAndLeaveRoomForEachOther) {
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

TEST_F(JobTest, ALongListStaysAControlMessage) {
  JobQueue queue(1 << 20, 1);
  v1::Submit submit;
  submit.set_name(std::string(max_job_name, 'x'));
  for (std::size_t i = 0; i < max_ended_jobs + 10; ++i) {
    queue.submit(submit, AssetHolds(*store_)).value();
    const auto job = queue.next(v1::CPU);
    v1::Failed failed;
    failed.set_reason(std::string(5000, 'x'));
    job->fail(failed);
    queue.ended(*job);
  }
  for (std::size_t i = 0; i < max_live_jobs; ++i) queue.submit(submit, AssetHolds(*store_)).value();
  v1::JobList list = queue.list();
  EXPECT_EQ(list.job_size(), static_cast<int>(max_ended_jobs + max_live_jobs));
  for (v1::JobSummary& summary : *list.mutable_job()) {
    summary.set_reason(std::string(max_reason, 'x'));
    summary.set_job_id(1ull << 62);
    summary.set_last_sequence(1ull << 62);
    summary.set_tiles(1u << 31);
    summary.set_tiles_done(1u << 31);
  }
  EXPECT_LE(list.ByteSizeLong() + 32, wire::max_control_frame);
}

}  // namespace metamer::service
