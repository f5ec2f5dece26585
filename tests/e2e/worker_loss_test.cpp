// A lost worker is the daemon's everyday business: it says so, goes on, and loses no pixel.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <iterator>
#include <thread>

#include "running_job.h"

namespace metamer::test {
namespace {

// Tests' daemons are told to start workers on any kernel; on one that can confine them they do.
TEST(Worker, IsConfinedAndHasNothingOfTheDaemonsEnvironment) {
  ASSERT_EQ(setenv("SECRET_OF_THE_DAEMON", "x", 1), 0);
  const Daemon daemon;
  unsetenv("SECRET_OF_THE_DAEMON");
  const std::string sandbox = daemon.json({"info"})["info"]["worker"][0]["sandbox"];
  if (sandbox.find("landlock:") != sandbox.npos) GTEST_SKIP() << sandbox;
  EXPECT_TRUE(sandbox.starts_with("landlock ")) << sandbox;
  EXPECT_NE(sandbox.find(", seccomp; memory: "), sandbox.npos) << sandbox;
  std::ifstream file("/proc/" + std::to_string(daemon.worker_pid()) + "/environ");
  std::string environment{std::istreambuf_iterator<char>(file), {}};
  std::replace(environment.begin(), environment.end(), '\0', ',');
  EXPECT_TRUE(file.is_open());
  EXPECT_EQ(environment.find("SECRET"), environment.npos);
  EXPECT_EQ(("," + environment).find(",PATH="), std::string::npos);
}

TEST(Worker, IsHeldToTheMemoryOfItsJobWhileItHasOne) {
  const Daemon daemon(Daemon::Listens::unix_socket, {"--memory", "16GiB"});
  const std::string sandbox = daemon.json({"info"})["info"]["worker"][0]["sandbox"];
  if (!sandbox.ends_with("; memory: limited for each job")) GTEST_SKIP() << sandbox;
  const pid_t worker = daemon.worker_pid();
  const auto limit = [&] {
    rlimit now{};  // 0 of a worker that has ended
    prlimit(worker, RLIMIT_DATA, nullptr, &now);
    return now.rlim_cur >> 20;
  };
  EXPECT_GE(limit(), 16u << 10);
  RunningJob job(daemon);
  EXPECT_GT(limit(), 0u);
  EXPECT_LT(limit(), 4u << 10);
  EXPECT_EQ(daemon.metamer({"cancel", job.id()}).code, 0);
  EXPECT_EQ(job.end().code, 5);
  // The client hears of the end at once, the daemon of the worker's later; where that one was too
  // slow to stop another has it.
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (daemon.worker_pid() == worker && limit() < 16u << 10) {
    ASSERT_LT(std::chrono::steady_clock::now(), end);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

struct Loss {
  const char* name;
  int signal;
  const char* reason;  ///< A part of what the retry has to say.
};

void PrintTo(const Loss& loss, std::ostream* stream) { *stream << loss.name; }

class WorkerLoss : public testing::TestWithParam<Loss> {};

/// Asks the daemon over and over whether it lives, in a thread of its own.
class Pinger {
 public:
  explicit Pinger(const Daemon& daemon)
      : thread_([this, &daemon] {
          while (!stop_) {
            failed_ += daemon.metamer({"info", "--json"}).code != 0;
            ++asked_;
          }
        }) {}
  ~Pinger() { stop(); }
  void stop() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }
  int asked() const { return asked_; }
  int failed() const { return failed_; }

 private:
  std::atomic<bool> stop_ = false;
  int asked_ = 0;
  int failed_ = 0;
  std::thread thread_;
};

TEST_P(WorkerLoss, IsToldAndMadeGood) {
  const Loss loss = GetParam();
  const Daemon daemon(Daemon::Listens::unix_socket, {"--worker-timeout", "3"});
  const pid_t worker = daemon.worker_pid();
  ASSERT_GT(worker, 0);

  // Lose the worker in the middle of a job.
  RunningJob job(daemon);
  Pinger pinger(daemon);
  const OtherProcess lost(worker);
  ASSERT_EQ(kill(worker, loss.signal), 0);
  const Json retrying = job.event("\"retrying\"");
  ASSERT_FALSE(retrying.is_null());
  const std::string reason = retrying["retrying"]["reason"];
  EXPECT_NE(reason.find(loss.reason), std::string::npos) << reason;
  EXPECT_TRUE(lost.ends());
  EXPECT_NE(daemon.worker_pid(), worker);

  // The job ends well all the same, and the daemon answered all the while.
  const RunningJob::End end = job.end();
  pinger.stop();
  EXPECT_EQ(end.code, 0);
  EXPECT_TRUE(end.last.contains("finished")) << end.last;
  EXPECT_GT(pinger.asked(), 0);
  EXPECT_EQ(pinger.failed(), 0);
  RecordProperty("pings", pinger.asked());

  // Its picture is that of an undisturbed run, and the next job renders.
  const Folder folder;
  const std::string disturbed = folder / "disturbed.exr";
  const std::string undisturbed = folder / "undisturbed.exr";
  EXPECT_EQ(daemon.metamer({"fetch", job.id(), "-o", disturbed, "--exr", "xyz"}).code, 0);
  const std::string scene = folder.write("long.txtpb", long_scene());
  EXPECT_EQ(daemon.metamer({"render", scene, "-o", undisturbed, "--exr", "xyz"}).code, 0);
  expect_same_pixels(read_exr(disturbed), read_exr(undisturbed), "after a lost worker");
}

INSTANTIATE_TEST_SUITE_P(Signals, WorkerLoss,
                         testing::Values(Loss{"Killed", SIGKILL, "signal 9"},
                                         Loss{"Aborted", SIGABRT, "signal 6"},
                                         Loss{"Stopped", SIGSTOP, "no sign of life"}),
                         [](const auto& info) { return info.param.name; });

TEST(WorkerLost, ThriceFailsTheJobWithItsReason) {
  const Daemon daemon;
  RunningJob job(daemon, endless_scene());
  for (int loss = 0; loss < 2; ++loss) {
    ASSERT_EQ(kill(daemon.worker_pid(), SIGKILL), 0);
    ASSERT_FALSE(job.event("\"retrying\"").is_null());
    ASSERT_FALSE(job.event("\"progress\"").is_null());
  }
  ASSERT_EQ(kill(daemon.worker_pid(), SIGKILL), 0);

  const RunningJob::End end = job.end();
  EXPECT_EQ(end.code, 4);
  ASSERT_TRUE(end.last.contains("failed")) << end.last;
  EXPECT_EQ(end.last["failed"]["kind"], "worker");
  const std::string reason = end.last["failed"]["reason"];
  EXPECT_NE(reason.find("signal 9"), std::string::npos) << reason;
  EXPECT_EQ(daemon.job_state(job.id()), "failed");

  // The same reason reaches whoever asks for the picture, and the next job renders.
  const Folder folder;
  const Ended fetched = daemon.metamer({"fetch", job.id(), "-o", folder / "a.png"});
  EXPECT_EQ(fetched.code, 4);
  EXPECT_NE(fetched.err.find("error: the job failed: " + reason), std::string::npos) << fetched.err;
  const std::string scene = folder.write("small.txtpb", small_scene());
  EXPECT_EQ(daemon.metamer({"render", scene, "-o", folder / "b.png"}).code, 0);
}

}  // namespace
}  // namespace metamer::test
