// Jobs by a real Slurm on the loopback: the pictures are those of this machine, bit for bit,
// whatever dies meanwhile.
#include "cluster_fixture.h"

#include <gtest/gtest.h>
#include <signal.h>

namespace metamer::test {
namespace {

using std::chrono::milliseconds;

class OnSlurm : public ClusterTest {};
class LongOnSlurm : public ClusterTest {
 protected:
  /// Some seconds of work.
  std::string scene_ = folder_.write("scene.txtpb", long_scene());
};

TEST_F(OnSlurm, TheBoothIsThatOfThisMachineBitForBit) {
  const std::string booth = METAMER_TEST_DATA "/../deploy/booth/booth.txtpb";
  const std::vector<std::string> settings = {"--size", "160x120",     "--spp",
                                             "4",      "--tile-size", "16"};
  const Image local = here(booth, settings);
  expect_a_picture(local);
  const auto server = daemon("0.05");
  const std::string job = submit(*server, booth, settings);
  expect_same_pixels(local, fetched(*server, job), "Slurm");
}

TEST_F(OnSlurm, ATurntablesFramesAreThoseOfThisMachineBitForBit) {
  turn(4, {"--size", "64x48", "--spp", "1", "--tile-size", "16"});
}

TEST_F(LongOnSlurm, TwentyFramesOfATurntableAreThoseOfThisMachineBitForBit) {
  turn(20, {"--size", "320x240", "--spp", "4"});
}

TEST_F(LongOnSlurm, ControllerThatIsKilledSoonAfterASubmissionLosesNothing) {
  const Image local = here(scene_, {"--spp", "8"});
  const auto server = daemon();
  for (int i = 0; i < 12; ++i) {
    const std::string job = submit(*server, scene_, {"--spp", "8"});
    std::this_thread::sleep_for(milliseconds(500 * (i + 1)));
    cluster_->kill_controller();
    std::this_thread::sleep_for(milliseconds(300));
    cluster_->start_controller();
    expect_same_pixels(local, fetched(*server, job),
                       "killed after " + std::to_string(i + 1) + "/2 s");
  }
}

TEST_F(LongOnSlurm, NodeThatIsSwitchedOffLosesNothing) {
  const Image local = here(scene_, {"--spp", "128"});
  const auto server = daemon();
  const std::string job = submit(*server, scene_, {"--spp", "128"});
  wait_for_tiles(*server, job);
  wait_for_workers(1);
  cluster_->power_off("n1");
  expect_same_pixels(local, fetched(*server, job), "a node switched off");
}

TEST_F(LongOnSlurm, DaemonThatIsKilledGoesOnWithTheTilesThatItHas) {
  const Image local = here(scene_, {"--spp", "128"});
  std::string job;
  {
    const auto server = daemon();
    job = submit(*server, scene_, {"--spp", "128"});
    wait_for_tiles(*server, job);
    server->signal(SIGKILL);
  }
  const auto server = daemon();
  expect_same_pixels(local, fetched(*server, job), "a daemon killed");
}

TEST_F(LongOnSlurm, JobWhoseWorkersAreKilledThriceFailsAndOthersGoOn) {
  const auto server = daemon();
  const std::string endless = folder_.write("endless.txtpb", endless_scene());
  const std::string job = submit(*server, endless);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(120);
  while (server->job_state(job) != "failed" && std::chrono::steady_clock::now() < end) {
    for (const pid_t worker : cluster_->workers()) kill(worker, SIGKILL);
    std::this_thread::sleep_for(milliseconds(100));
  }
  const Ended jobs = server->metamer({"jobs"});
  EXPECT_NE(jobs.out.find("a task was lost 3 times: killed by signal 9 (Killed) (on n"),
            std::string::npos)
      << jobs.out;
  const std::string small = folder_.write("small.txtpb", small_scene());
  expect_same_pixels(here(small, {}), fetched(*server, submit(*server, small)), "the next one");
}

TEST_F(LongOnSlurm, FiveHundredSmallTasksAreCountedOnceEach) {
  // 675 tiles: the first task has those of two seconds, and each other one has one.
  const std::vector<std::string> settings = {"--size", "432x400",     "--spp",
                                             "1024",   "--tile-size", "16"};
  const Here local = counted_here(scene_, settings);
  const auto server = daemon("0.01");
  const std::string job = submit(*server, scene_, settings);
  expect_once(local, *server, job, "hundreds of tasks");
  EXPECT_GE(cluster_->tasks_submitted(), 500);
}

/// A node has a graphics processor where Slurm is told so; llvmpipe here.
class LongGlOnSlurm : public ClusterTest {
 protected:
  LongGlOnSlurm() : ClusterTest({.gpu = true}) {}
};

TEST_F(LongGlOnSlurm, PicturesOfGlAreThoseOfThisMachineBitForBit) {
  const std::string booth = METAMER_TEST_DATA "/../deploy/booth/booth.txtpb";
  const std::vector<std::string> settings = {"--size",      "320x240", "--spp",     "16",
                                             "--tile-size", "8",       "--backend", "gl"};
  const Image local = here(booth, settings);
  expect_a_picture(local);
  const auto server = daemon("1", {"--slurm-gres", "gpu:1"});
  const std::string job = submit(*server, booth, settings);
  expect_same_pixels(local, fetched(*server, job), "GL by Slurm");
  EXPECT_EQ(cluster_->tasks_submitted(), 1);
}

TEST_F(LongOnSlurm, CancelledJobLeavesNoTask) {
  const auto server = daemon();
  const std::string job = submit(*server, folder_.write("endless.txtpb", endless_scene()));
  wait_for_workers(1);
  EXPECT_EQ(server->metamer({"cancel", job}).code, 0);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!cluster_->workers().empty() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(milliseconds(50));
  EXPECT_TRUE(cluster_->workers().empty());
}

}  // namespace
}  // namespace metamer::test
