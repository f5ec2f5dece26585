// Jobs by a real Slurm on the loopback: the pictures are those of this machine, bit for bit,
// whatever dies meanwhile.
#include "cluster.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <thread>

#include "tests/e2e/daemon.h"
#include "tests/e2e/scenes.h"

namespace metamer::test {
namespace {

using std::chrono::milliseconds;

class ClusterTest : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string lacks = Cluster::lacks(); !lacks.empty()) GTEST_SKIP() << lacks;
    cluster_ = std::make_unique<Cluster>();
  }

  std::unique_ptr<Daemon> daemon(const std::string& task_time = "1") const {
    return std::make_unique<Daemon>(Daemon::Listens::unix_socket, cluster_->words(task_time));
  }
  /// The job's number, without its server.
  static std::string submit(const Daemon& server, const std::string& scene,
                            const std::vector<std::string>& settings = {}) {
    const std::string handle = server.submit(scene, settings);
    return handle.substr(0, handle.find('@'));
  }
  /// By this machine, which uses no more of its processor than any node.
  Image here(const std::string& scene, const std::vector<std::string>& settings) {
    const Daemon server(Daemon::Listens::unix_socket, {"--isa", "avx2"});
    return fetched(server, submit(server, scene, settings));
  }
  /// Of a job, once it has ended.
  Image fetched(const Daemon& server, const std::string& job) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(240);
    for (std::string state; state != "finished" && state != "failed";
         state = server.job_state(job)) {
      if (std::chrono::steady_clock::now() > end) break;
      std::this_thread::sleep_for(milliseconds(200));
      cluster_->resume_nodes();
    }
    const std::string file = folder_ / ("fetched" + std::to_string(++count_) + ".exr");
    const Ended ended = server.metamer({"fetch", job, "-o", file, "--exr", "xyz"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    return ended.code == 0 ? read_exr(file) : Image{};
  }
  /// Until some of the picture is there.
  static void wait_for_tiles(const Daemon& server, const std::string& job) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (std::chrono::steady_clock::now() < end) {
      const Json answer = server.json({"jobs"});
      for (const Json& one : answer["jobs"])
        if (std::to_string(one["job_id"].get<std::uint64_t>()) == job && one["tiles_done"] > 0)
          return;
      std::this_thread::sleep_for(milliseconds(50));
    }
    ADD_FAILURE() << "no tile has come";
  }
  void wait_for_workers(std::size_t count) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (cluster_->workers().size() < count && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(milliseconds(20));
    EXPECT_GE(cluster_->workers().size(), count);
  }

  /// A turntable of the booth, by the cluster and by this machine: the same frames, bit for bit.
  void turn(int frames, const std::vector<std::string>& settings) {
    const auto turned = [&](const Daemon& server, const std::string& name) {
      std::vector<std::string> words = {
          "turntable", METAMER_TEST_DATA "/../deploy/booth/booth.txtpb",
          "--frames",  "0:" + std::to_string(frames - 1),
          "--count",   "200",
          "-o",        folder_ / (name + "-%d.exr"),
          "--exr",     "xyz"};
      words.insert(words.end(), settings.begin(), settings.end());
      return server.json(words);
    };
    turned(Daemon(Daemon::Listens::unix_socket, {"--isa", "avx2"}), "here");
    const auto server = daemon("0.05");
    const Json answer = turned(*server, "there");
    EXPECT_EQ(answer["series"]["done"], frames) << answer;
    for (const Json& frame : answer["frames"]) {
      const std::string number = std::to_string(frame["frame"].get<int>()) + ".exr";
      expect_same_pixels(read_exr(folder_ / ("here-" + number)),
                         read_exr(folder_ / ("there-" + number)), number);
      // Each tile is some node's.
      const Json record = server->json({"jobs", "--record", frame["handle"]});
      std::uint64_t tiles = 0;
      for (const Json& machine : record["record"]["machine"]) {
        EXPECT_EQ(machine["name"].get<std::string>().front(), 'n') << machine;
        tiles += machine["tiles"].get<std::uint64_t>();
      }
      EXPECT_GT(tiles, 0u);
      EXPECT_EQ(record["record"], frame["record"]);
    }
  }

  Folder folder_;
  std::unique_ptr<Cluster> cluster_;
  int count_ = 0;
};

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
  const Image local = here(scene_, {});
  const auto server = daemon();
  const std::string job = submit(*server, scene_);
  wait_for_tiles(*server, job);
  wait_for_workers(1);
  cluster_->power_off("n1");
  expect_same_pixels(local, fetched(*server, job), "a node switched off");
}

TEST_F(LongOnSlurm, DaemonThatIsKilledGoesOnWithTheTilesThatItHas) {
  const Image local = here(scene_, {});
  std::string job;
  {
    const auto server = daemon();
    job = submit(*server, scene_);
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

TEST_F(LongOnSlurm, HundredsOfSmallTasksAreCountedOnceEach) {
  const Image local = here(scene_, {"--spp", "8"});
  const auto server = daemon("0.01");
  const std::string job = submit(*server, scene_, {"--spp", "8"});
  expect_same_pixels(local, fetched(*server, job), "hundreds of tasks");
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
