// Stopping: by a request, by Ctrl-C, for a while, and by the loss of the server.
#include <gtest/gtest.h>
#include <signal.h>

#include <boost/asio.hpp>
#include <chrono>
#include <iostream>

#include "client/session/session.h"
#include "running_job.h"

namespace metamer::test {
namespace {

using namespace client;

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::time_point begin, Clock::time_point end) {
  return std::chrono::duration<double, std::milli>(end - begin).count();
}

/// When what happened, as a session in this very process sees it: no program's start is counted.
struct CancelTimes {
  Clock::time_point asked, told, next_started;
  bool cancelled = false;
};

boost::asio::awaitable<void> cancel_in_the_middle(Session& session, std::uint64_t job_id,
                                                  const Submission& next, CancelTimes& times) {
  // Cancel at the first sign of progress, while watching.
  const auto executor = co_await boost::asio::this_coro::executor;
  v1::Watch request;
  request.set_job_id(job_id);
  bool asked = false;
  Session::OnEvent on_event = [&](const v1::JobEvent& event) -> Answer<void> {
    if (event.has_progress() && event.progress().tiles_done() > 0 && !asked) {
      asked = true;
      times.asked = Clock::now();
      boost::asio::co_spawn(executor, session.cancel(job_id), boost::asio::detached);
    }
    if (event.has_cancelled()) {
      times.told = Clock::now();
      times.cancelled = true;
    }
    return {};
  };
  const Answer<void> watched = co_await session.watch(request, on_event);
  EXPECT_TRUE(watched);

  // The worker is free when the next job has it.
  const Answer<std::uint64_t> next_id = co_await session.submit(next);
  EXPECT_TRUE(next_id);
  if (!next_id) co_return;
  v1::Watch next_request;
  next_request.set_job_id(*next_id);
  Session::OnEvent on_next = [&](const v1::JobEvent& event) -> Answer<void> {
    if (event.has_planned()) times.next_started = Clock::now();
    return {};
  };
  const Answer<void> next_watched = co_await session.watch(next_request, on_next);
  EXPECT_TRUE(next_watched);
}

TEST(Cancel, EndsARunningJobAndFreesItsWorker) {
  const Daemon daemon;
  const Folder folder;
  const std::string job = daemon.submit(folder.write("endless.txtpb", endless_scene()));
  const auto small = SceneFile::parse(small_scene(), "small.txtpb");
  ASSERT_TRUE(small);
  const Submission next = make_submission(small->scene(), {}, "small.txtpb", false);

  CancelTimes times;
  boost::asio::io_context loop(1);
  const auto main = [&]() -> boost::asio::awaitable<void> {
    Answer<std::unique_ptr<Session>> session = co_await Session::connect(daemon.address());
    EXPECT_TRUE(session);
    if (session) co_await cancel_in_the_middle(**session, std::stoull(job), next, times);
  };
  boost::asio::co_spawn(loop, main(), boost::asio::detached);
  loop.run();

  EXPECT_TRUE(times.cancelled);
  EXPECT_EQ(daemon.job_state(job), "cancelled");
  const double told = milliseconds(times.asked, times.told);
  const double planned = milliseconds(times.asked, times.next_started);
  std::cout << "cancelled after " << told << " ms, the next job planned after " << planned
            << " ms\n";
  RecordProperty("cancelled_us", static_cast<int>(told * 1e3));
  RecordProperty("next_planned_us", static_cast<int>(planned * 1e3));

  // What was rendered is dropped.
  const Ended fetched = daemon.metamer({"fetch", job, "-o", folder / "gone.png"});
  EXPECT_EQ(fetched.code, 5) << fetched.err;
}

TEST(Cancel, ByTheCommandTellsTheNewState) {
  const Daemon daemon;
  RunningJob job(daemon, endless_scene());
  const Json answer = daemon.json({"cancel", job.id()});
  EXPECT_EQ(answer.value("/job/state"_json_pointer, ""), "cancelled") << answer;
  const RunningJob::End end = job.end();
  EXPECT_EQ(end.code, 5);
  EXPECT_TRUE(end.last.contains("cancelled")) << end.last;
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
  const Daemon daemon(Daemon::Listens::unix_socket, {"--worker-timeout", "60"});
  const Folder folder;
  const std::string scene = folder.write("long.txtpb", long_scene());
  RunningJob job(daemon);

  HeldWorkers held(daemon);
  const Json paused = daemon.json({"pause", job.id()});
  ASSERT_EQ(paused.value("/job/state"_json_pointer, ""), "paused") << paused;
  ASSERT_FALSE(job.event("\"paused\"").is_null());
  held.release();
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
