// A job by itself, without workers and sockets.

#include "server/service/jobs/job.h"

#include "job_fixture.h"
#include "server/service/limits.h"

namespace metamer::service {

TEST_F(JobTest, AStepThatTheStateForbidsChangesNothing) {
  auto job = make_job();
  const auto before = job->log().last_sequence();
  EXPECT_FALSE(job->resume(0));
  EXPECT_FALSE(job->finish({}));
  EXPECT_FALSE(job->retry("lost"));
  EXPECT_EQ(job->state(), v1::QUEUED);
  EXPECT_EQ(job->log().last_sequence(), before);
}

TEST_F(JobTest, AWorkerMayBeLostTwiceAndNotThrice) {
  auto job = running_job();
  for (int loss = 0; loss < 2; ++loss) {
    EXPECT_TRUE(job->retry("killed by signal 9 (Killed)"));
    EXPECT_EQ(job->state(), v1::QUEUED);
    EXPECT_TRUE(job->start());
  }
  EXPECT_FALSE(job->retry("killed by signal 9 (Killed)"));
  EXPECT_EQ(job->state(), v1::RUNNING);
  const auto events = read(*job, {});
  EXPECT_EQ(events.back().started().attempt(), 3u);
}

TEST_F(JobTest, AYieldCostsNoAttemptAndSaysWhy) {
  auto job = running_job();
  for (int turn = 0; turn < 10; ++turn) {
    EXPECT_TRUE(job->yield("others have their turn", 3));
    EXPECT_EQ(job->state(), v1::QUEUED);
    const auto events = read(*job, {});
    EXPECT_EQ(events.back().queued().reason(), "others have their turn");
    EXPECT_EQ(events.back().queued().position(), 3u);
    EXPECT_TRUE(job->start());
    EXPECT_EQ(read(*job, {}).back().started().attempt(), 1u);
  }
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

TEST_F(JobTest, APictureOutlivesItsFactors) {
  v1::Submit submit;
  submit.set_keep_factors(true);
  auto job = std::make_shared<Job>(7, submit, AssetHolds(*store_), 0);
  ASSERT_TRUE(job->start() && job->plan(plan(32, 16, 16)) && job->make_film());
  constexpr std::uint64_t most = 10;
  ASSERT_TRUE(job->add_factors(0u, "12345678", most));
  job->add_tile(0, 1);
  for (const char* piece : {"9", "10", "1"}) ASSERT_TRUE(job->add_factors(1u, piece, most));
  job->add_tile(1, 1);
  EXPECT_EQ(job->tiles_done(), 2u);
  std::vector<std::string> kept;
  std::uint64_t from = 1;
  while (const auto entry = job->log().next(from, {.tiles = true})) {
    if (entry->sequence < from) break;
    from = entry->sequence + 1;
    const auto event = job->event(*entry, true).value();
    if (event.has_tile()) kept.push_back(event.tile().factors());
  }
  EXPECT_EQ(kept, (std::vector<std::string>{"12345678", ""}));
}

}  // namespace metamer::service
