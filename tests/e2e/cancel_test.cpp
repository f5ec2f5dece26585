// Stopping: by a request, by Ctrl-C, for a while, and by the loss of the server.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <iostream>

#include "running_job.h"

namespace metamer::test {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

TEST(Cancel, EndsARunningJobAndFreesItsWorker) {
  const Daemon daemon;
  const Folder folder;
  const std::string small = folder.write("small.txtpb", small_scene());
  RunningJob job(daemon, endless_scene());

  // Cancel it, and see how soon the next job gets the worker.
  const Clock::time_point asked = Clock::now();
  const Json answer = daemon.json({"cancel", job.id()});
  EXPECT_EQ(answer.value("/job/state"_json_pointer, ""), "cancelled") << answer;
  const RunningJob::End end = job.end();
  const double told = milliseconds_since(asked);
  EXPECT_EQ(end.code, 5);
  EXPECT_TRUE(end.last.contains("cancelled")) << end.last;
  EXPECT_EQ(daemon.metamer({"render", small, "-o", folder / "next.png"}).code, 0);
  const double next = milliseconds_since(asked);

  // Include the start of a process each: metamer cancel, metamer render.
  std::cout << "cancelled after " << told << " ms, the next job done after " << next << " ms\n";
  RecordProperty("cancelled_ms", static_cast<int>(told));
  RecordProperty("next_job_done_ms", static_cast<int>(next));

  // What was rendered is dropped.
  const Ended fetched = daemon.metamer({"fetch", job.id(), "-o", folder / "gone.png"});
  EXPECT_EQ(fetched.code, 5) << fetched.err;
}

TEST(Cancel, OfAnEndedJobIsRefused) {
  const Daemon daemon;
  const Folder folder;
  const std::string job = daemon.submit(folder.write("small.txtpb", small_scene()));
  EXPECT_EQ(daemon.metamer({"watch", job}).code, 0);
  const Ended ended = daemon.metamer({"cancel", job});
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.out, "");
  EXPECT_NE(ended.err.find("error: "), std::string::npos);
}

TEST(CtrlC, CancelsTheJobOnTheServer) {
  const Daemon daemon;
  const Folder folder;
  const std::string scene = folder.write("endless.txtpb", endless_scene());
  const auto client = daemon.start({"render", scene, "-o", folder / "never.png"});
  ASSERT_TRUE(client->line_err("planned: "));
  client->signal(SIGINT);
  const Ended ended = client->wait();
  EXPECT_EQ(ended.code, 5);
  EXPECT_EQ(ended.out, "");
  EXPECT_NE(ended.err.find("error: cancelled\n"), std::string::npos) << ended.err;
  EXPECT_EQ(daemon.job_state("1"), "cancelled");
}

TEST(CtrlC, EndsAPrivateServerToo) {
  const Folder folder;
  const std::string scene = folder.write("endless.txtpb", endless_scene());
  Process client({"metamer", "render", scene, "-o", folder / "never.png"});
  ASSERT_TRUE(client.line_err("planned: "));
  const std::vector<pid_t> daemons = children_of(client.pid());
  ASSERT_EQ(daemons.size(), 1u);
  const OtherProcess daemon(daemons[0]);
  client.signal(SIGINT);
  EXPECT_EQ(client.wait().code, 5);
  EXPECT_TRUE(daemon.ends());
}

TEST(CtrlC, TheSecondOneLeavesAtOnce) {
  Daemon daemon;
  const Folder folder;
  const std::string scene = folder.write("endless.txtpb", endless_scene());
  const auto client = daemon.start({"render", scene, "-o", folder / "never.png"});
  ASSERT_TRUE(client->line_err("planned: "));
  daemon.signal(SIGSTOP);  // nobody answers the first
  client->signal(SIGINT);
  ASSERT_TRUE(client->line_err("cancelling"));
  client->signal(SIGINT);
  EXPECT_EQ(client->wait().code, 5);
}

TEST(Pause, KeepsTheTilesAndResumeFinishesThem) {
  const Daemon daemon;
  const Folder folder;
  const std::string scene = folder.write("long.txtpb", long_scene());
  RunningJob job(daemon);

  const Json paused = daemon.json({"pause", job.id()});
  ASSERT_EQ(paused.value("/job/state"_json_pointer, ""), "paused") << paused;
  ASSERT_FALSE(job.event("\"paused\"").is_null());
  const std::uint32_t kept = paused["job"]["tiles_done"];
  EXPECT_GT(kept, 0u);
  EXPECT_EQ(daemon.job_state(job.id()), "paused");

  // Others have the worker meanwhile.
  const std::string small = folder.write("small.txtpb", small_scene());
  EXPECT_EQ(daemon.metamer({"render", small, "-o", folder / "small.png"}).code, 0);

  const Json resumed = daemon.json({"resume", job.id()});
  EXPECT_EQ(resumed["exit_code"], 0) << resumed;
  const RunningJob::End end = job.end();
  EXPECT_EQ(end.code, 0);
  const std::string file = folder / "paused.exr";
  const std::string undisturbed = folder / "undisturbed.exr";
  EXPECT_EQ(daemon.metamer({"fetch", job.id(), "-o", file, "--exr", "xyz"}).code, 0);
  EXPECT_EQ(daemon.metamer({"render", scene, "-o", undisturbed, "--exr", "xyz"}).code, 0);
  expect_same_pixels(read_exr(file), read_exr(undisturbed), "after a pause");
}

TEST(ServerLostInMidStream, TellsHowToContinue) {
  Daemon daemon;
  const Folder folder;
  const std::string scene = folder.write("endless.txtpb", endless_scene());
  const std::string file = folder / "a.exr";
  const auto client = daemon.start({"render", scene, "-o", file, "--exr", "xyz"});
  ASSERT_TRUE(client->line_err("planned: "));
  daemon.signal(SIGKILL);
  const Ended ended = client->wait();
  EXPECT_EQ(ended.code, 3);
  EXPECT_NE(ended.err.find("error: lost the connection to " + daemon.address() + ": "),
            std::string::npos)
      << ended.err;
  EXPECT_NE(ended.err.find("metamer fetch 1 --server " + daemon.address() + " -o " + file +
                           " --exr xyz\n"),
            std::string::npos)
      << ended.err;
}

}  // namespace
}  // namespace metamer::test
