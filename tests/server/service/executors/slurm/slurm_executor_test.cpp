// Jobs by Slurm, whose commands are scripts and whose tasks run the fake worker: the picture is
// that of this machine's worker, each tile comes once, and what is lost comes again.
#include "server/service/executors/slurm/slurm_executor.h"

#include <gtest/gtest.h>

#include <chrono>
#include <map>

#include "../../daemon.h"
#include "fake_slurm.h"
#include "server/service/executors/slurm/task_name.h"

namespace metamer::service::test {
namespace {

using std::chrono::milliseconds;

struct SlurmStory {
  v1::JobEvent end;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> tiles;  // how often each came
  std::string pixels;                                            // of all, by place
};

class Slurm : public testing::Test {
 protected:
  static void by_slurm(ServiceOptions& options, const std::filesystem::path& folder) {
    options.executor = "slurm";
    options.slurm.folder = folder;
    options.slurm.look = milliseconds(20);
    options.slurm.listing = milliseconds(20);
    options.slurm.try_again = milliseconds(50);
    options.slurm.patience = milliseconds(400);
    options.slurm.run.pilot_time = milliseconds(0);
    options.slurm.run.task_time = milliseconds(0);
  }
  void start(const std::function<void(ServiceOptions&)>& change = {}) {
    daemon_.emplace([&](ServiceOptions& options) {
      by_slurm(options, folder_.path() / "shared");
      if (change) change(options);
    });
    client_.emplace(daemon_->socket());
    client_->hello();
  }
  SlurmStory follow(std::uint64_t job) {
    client_->watch(job, 0, true);
    SlurmStory story;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> by_place;
    for (;;) {
      const v1::JobEvent event = client_->receive_event();
      if (event.has_tile()) {
        const std::pair place(event.tile().y(), event.tile().x());
        ++story.tiles[place];
        by_place[place] = event.tile().xyz();
      }
      if (!event.has_finished() && !event.has_failed() && !event.has_cancelled()) continue;
      story.end = event;
      for (const auto& [place, xyz] : by_place) story.pixels += xyz;
      return story;
    }
  }
  SlurmStory render(const std::string& script) { return follow(client_->submit(script)); }
  /// Twelve tiles.
  std::uint64_t submit_gl() {
    v1::Envelope message;
    message.mutable_submit()->set_name("scene");
    message.mutable_submit()->set_scene_sha256(client_->upload({"picture 64 48 16"})[0]);
    message.mutable_submit()->set_backend(v1::GL);
    return client_->ask(message).submitted().job_id();
  }
  static void expect_once(const SlurmStory& story, std::size_t tiles) {
    EXPECT_TRUE(story.end.has_finished()) << story.end.ShortDebugString();
    EXPECT_EQ(story.tiles.size(), tiles);
    for (const auto& [place, times] : story.tiles) EXPECT_EQ(times, 1);
  }
  void wait_until(const std::function<bool()>& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!done()) {
      ASSERT_LT(std::chrono::steady_clock::now(), end);
      std::this_thread::sleep_for(milliseconds(5));
    }
  }

  FakeSlurm slurm_;
  TemporaryFolder folder_ = TemporaryFolder::make().value();
  std::optional<Daemon> daemon_;
  std::optional<Client> client_;
};

/// 12 tiles: the first task draws 4, and each other one.
constexpr const char* twelve = "picture 64 48 16";

TEST_F(Slurm, MakesThePictureOfThisMachinesWorkerAndEachTileOnce) {
  std::string here;
  {
    Daemon daemon;
    client_.emplace(daemon.socket());
    client_->hello();
    here = render(twelve).pixels;
    client_.reset();
  }
  start();
  const SlurmStory story = render(twelve);
  expect_once(story, 12);
  EXPECT_EQ(story.pixels, here);
  EXPECT_EQ(slurm_.submitted(), 9u);
  EXPECT_NE(slurm_.first_words().find("--parsable --no-requeue --job-name=metamer-"),
            std::string::npos);
  EXPECT_NE(slurm_.first_words().find("--array=0-0 --ntasks=1 --cpus-per-task=1 --nice=100"),
            std::string::npos);
}

TEST_F(Slurm, GlIsDrawnByTasksThatTakeAGpuWhereTheyAreToldWhich) {
  start([](ServiceOptions& options) { options.slurm.commands.gres = "gpu:1"; });
  const std::uint64_t job = submit_gl();
  expect_once(follow(job), 12);
  EXPECT_NE(slurm_.first_words().find(" --gres=gpu:1"), std::string::npos) << slurm_.first_words();
  EXPECT_NE(slurm_.first_script().find(" --gl-device auto"), std::string::npos)
      << slurm_.first_script();
  EXPECT_EQ(slurm_.submitted(), 9u);
}

TEST_F(Slurm, GlStaysHereWithoutAGpuToAskFor) {
  start();
  const std::uint64_t job = submit_gl();
  expect_once(follow(job), 12);
  EXPECT_EQ(slurm_.submitted(), 0u);
}

TEST_F(Slurm, TasksAreAsLongAsIsWorthTheirStart) {
  start([](ServiceOptions& options) { options.slurm.run.task_time = milliseconds(3'600'000); });
  expect_once(render(twelve), 12);
  EXPECT_EQ(slurm_.submitted(), 2u);
}

TEST_F(Slurm, KeepsFactors) {
  start();
  const std::uint64_t job = client_->submit("factors 1000", false, true);
  client_->watch(job, 0, true, false, true);
  int with_factors = 0;
  std::size_t scene = 0;
  client_->receive_event_until([&](const v1::JobEvent& event) {
    with_factors += event.tile().factors().size() == 1000;
    scene = std::max(scene, event.planned().factors().size());
    return event.has_finished() || event.has_failed();
  });
  EXPECT_EQ(with_factors, 12);
  EXPECT_EQ(scene, 1000u);
}

TEST_F(Slurm, ChecksThePictureInATaskThatHasAllOfIt) {
  start();
  const SlurmStory story = render("picture 64 48 16 verify");
  expect_once(story, 12);
  EXPECT_TRUE(story.end.finished().has_accuracy()) << story.end.ShortDebugString();
  EXPECT_TRUE(story.end.finished().accuracy().kept());
}

TEST_F(Slurm, JobThatIsOnlyCheckedTakesOneTaskAndNoPicture) {
  start();
  const SlurmStory story = follow(client_->submit(twelve, true));
  EXPECT_TRUE(story.end.has_finished());
  EXPECT_TRUE(story.tiles.empty());
  EXPECT_EQ(slurm_.submitted(), 1u);
}

TEST_F(Slurm, WhatItForgetsIsSubmittedAgainAndIsNotTheJobsFault) {
  slurm_.say("forget");
  start();
  const std::uint64_t job = client_->submit(twelve);
  wait_until([&] { return slurm_.submitted() >= 5; });
  slurm_.take_back("forget");
  expect_once(follow(job), 12);
}

TEST_F(Slurm, TaskThatEndsThriceWithoutAResultFailsItsJobAndNoOther) {
  start();
  slurm_.say("nothing");
  const SlurmStory story = render(twelve);
  ASSERT_TRUE(story.end.has_failed());
  EXPECT_EQ(story.end.failed().kind(), v1::Failed::WORKER);
  EXPECT_EQ(story.end.failed().reason(),
            "a task was lost 3 times: ended as COMPLETED without a result on fake1");
  slurm_.take_back("nothing");
  expect_once(render(twelve), 12);
}

TEST_F(Slurm, TaskThatCanLeaveNoResultSaysWhy) {
  start();
  slurm_.say("speechless");
  const SlurmStory story = render(twelve);
  ASSERT_TRUE(story.end.has_failed());
  EXPECT_EQ(story.end.failed().reason(),
            "a task was lost 3 times: ended as FAILED without a result on fake1: "
            "metamer-worker: the disk is full?");
}

TEST_F(Slurm, WorkerThatCrashesThriceFailsItsJobAndOnceDoesNot) {
  start();
  const SlurmStory thrice = render("crash 2");
  ASSERT_TRUE(thrice.end.has_failed());
  EXPECT_EQ(thrice.end.failed().reason(),
            "a task was lost 3 times: killed by signal 6 (Aborted) (on fake1)");
  EXPECT_EQ(slurm_.submitted(), 3u);
  expect_once(render("picture 64 48 16 crash 2 once"), 12);
}

TEST_F(Slurm, ScenesFaultFailsItsJobAtOnce) {
  start();
  const SlurmStory story = render("fail");
  EXPECT_EQ(story.end.failed().kind(), v1::Failed::BAD_INPUT);
  EXPECT_EQ(slurm_.submitted(), 1u);
}

TEST_F(Slurm, BrokenPromiseBeginsAnewWithABetterMethod) {
  start();
  const SlurmStory story = render("picture 16 16 16 broken");
  EXPECT_TRUE(story.end.has_finished()) << story.end.ShortDebugString();
  EXPECT_EQ(slurm_.submitted(), 2u);
}

TEST_F(Slurm, ThatDoesNotAnswerIsWaitedForAndSaid) {
  start();
  slurm_.say("refuse");
  const std::uint64_t job = client_->submit(twelve);
  wait_until(
      [&] { return client_->summary(job).reason().find("Invalid account") != std::string::npos; });
  slurm_.take_back("refuse");
  expect_once(follow(job), 12);
}

TEST_F(Slurm, CancelAndPauseEndTheTasksAndResumeGoesOnWithTheTilesThatAreThere) {
  start();
  slurm_.say("hold");
  const std::uint64_t cancelled = client_->submit(twelve);
  wait_until([&] { return slurm_.submitted() == 1; });
  v1::Envelope message;
  message.mutable_cancel()->set_job_id(cancelled);
  client_->ask(message);
  wait_until([&] { return slurm_.cancelled() >= 1; });
  slurm_.take_back("hold");

  const std::uint64_t job = client_->submit("picture 64 48 16 crash 20");
  client_->watch(job);
  client_->receive_event_until([](const v1::JobEvent& event) { return event.has_started(); });
  message.Clear();
  message.mutable_pause()->set_job_id(job);
  const v1::Envelope paused = client_->ask(message);
  if (paused.has_error()) return;  // it was quicker
  message.Clear();
  message.mutable_resume()->set_job_id(job);
  EXPECT_FALSE(client_->ask(message).has_error());
  client_->receive_event_until([](const v1::JobEvent& event) { return event.has_finished(); });
}

TEST_F(Slurm, SaysWhereAJobRuns) {
  start();
  slurm_.say("hold");
  const std::uint64_t job = client_->submit(twelve);
  wait_until(
      [&] { return client_->summary(job).reason() == "no task runs yet; 1 waiting for Slurm"; });
  slurm_.take_back("hold");
  expect_once(follow(job), 12);
}

TEST_F(Slurm, TasksOfAnEarlierServerAreCancelledAndTheirFilesRemoved) {
  const auto state = folder_.path() / "state";
  std::filesystem::create_directories(state);
  const auto keeps = [&](ServiceOptions& options) { options.state = state; };
  start(keeps);
  expect_once(render(twelve), 12);
  const std::string prefix = slurm_.first_words().substr(slurm_.first_words().find("metamer-"), 21);
  client_.reset();
  daemon_.reset();
  slurm_.list_stranger(prefix + "left");
  slurm_.list_stranger("metamer-of-another-server");
  const auto leaving = folder_.path() / "shared" / (prefix + "left");
  std::filesystem::create_directories(leaving);
  start(keeps);
  const std::uint64_t job = client_->submit(twelve);
  wait_until([&] { return slurm_.was_cancelled(prefix + "left"); });
  expect_once(follow(job), 12);
  EXPECT_FALSE(slurm_.was_cancelled("metamer-of-another-server"));
  EXPECT_FALSE(std::filesystem::exists(leaving));
}

TEST_F(Slurm, JobThatAServerLeftGoesOnWithTheNextOneWhoeverAsks) {
  const auto state = folder_.path() / "state";
  std::filesystem::create_directories(state);
  const auto keeps = [&](ServiceOptions& options) {
    options.state = state;
    options.store.clear();  // in the shared folder
  };
  start(keeps);
  slurm_.say("hold");
  const std::uint64_t job = client_->submit(twelve);
  wait_until([&] { return slurm_.submitted() == 1; });
  client_.reset();
  daemon_.reset();
  slurm_.take_back("hold");
  start(keeps);
  wait_until([&] { return client_->summary(job).state() == v1::FINISHED; });
  expect_once(follow(job), 12);
}

TEST_F(Slurm, NamesNeverComeTwice) {
  const std::string prefix = task_prefix("server");
  EXPECT_EQ(prefix, task_prefix("server"));
  EXPECT_NE(prefix, task_prefix("other"));
  EXPECT_NE(task_prefix(""), task_prefix(""));
  EXPECT_NE(new_task_name(prefix), new_task_name(prefix));
}

}  // namespace
}  // namespace metamer::service::test
