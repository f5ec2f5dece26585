// Whatever a worker does, its job gets a reason, the daemon answers, and the next job renders.

#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>

#include "../daemon.h"

namespace metamer::service::test {

namespace {

using std::chrono::milliseconds;
using std::chrono::minutes;

v1::WorkerInfo worker_info(Client& client) {
  v1::Envelope message;
  message.mutable_get_info();
  return client.ask(message).info().worker(0);
}

bool ends(const v1::JobEvent& event) {
  return event.has_finished() || event.has_failed() || event.has_cancelled();
}

/// The events that say what became of the workers and the job.
struct Story {
  std::vector<std::string> retries;
  v1::JobEvent end;
  int tiles = 0;
};

Story follow(Client& client, std::uint64_t job) {
  client.watch(job);
  Story story;
  while (true) {
    const v1::JobEvent event = client.receive_event();
    if (event.has_retrying()) story.retries.push_back(event.retrying().reason());
    if (event.has_tile()) ++story.tiles;
    if (!ends(event)) continue;
    story.end = event;
    return story;
  }
}

struct Trouble {
  const char* name;
  const char* script;
  const char* reason;
};

void PrintTo(const Trouble& trouble, std::ostream* stream) { *stream << trouble.name; }

class WorkerTrouble : public testing::TestWithParam<Trouble> {
 protected:
  /// Only who is to run into a limit has a short one: a busy machine keeps others waiting, too.
  static void hurry(ServiceOptions& options) {
    if (GetParam().name == std::string("hangs")) options.worker.worker_timeout = milliseconds(1000);
    if (GetParam().name == std::string("stalls")) options.worker.stall_timeout = milliseconds(2000);
  }
  Daemon daemon_{hurry};
  Client client_{daemon_.socket()};
  void SetUp() override { client_.hello(); }
};

constexpr Trouble troubles[] = {
    {"aborts", "crash 5", "killed by signal 6 (Aborted)"},
    {"aborts_before_the_first_tile", "crash 0", "killed by signal 6 (Aborted)"},
    {"aborts_after_the_last_tile", "crash 12", "killed by signal 6 (Aborted)"},
    {"exits", "exit 5", "exited with code 3"},
    {"hangs", "hang 5", "stopped answering: no sign of life for 1 s"},
    {"stalls", "stall 5", "stopped answering: its work stood still for 2 s"},
    {"sends_garbage", "garbage 5",
     "sent a frame that can't be read: the frame's length is over the limit"},
    {"sends_a_tile_of_nothing", "stray", "sent a tile that was not asked for"},
    {"says_done_too_early", "early", "said that a job is done which is not"},
};

}  // namespace

TEST_P(WorkerTrouble, OnceIsMadeGood) {
  const Story story = follow(client_, client_.submit(GetParam().script + std::string(" once")));
  ASSERT_EQ(story.retries.size(), 1u);
  EXPECT_EQ(story.retries[0], std::string("the worker was lost: ") + GetParam().reason);
  EXPECT_TRUE(story.end.has_finished()) << story.end.ShortDebugString();
  EXPECT_EQ(story.tiles, 12);  // each of them once
  // Whoever drew them, and could not say so any more.
  std::uint32_t recorded = 0;
  for (const v1::MachineRecord& machine : story.end.finished().record().machine())
    recorded += machine.tiles();
  EXPECT_EQ(recorded, 12u);
}

TEST(AWorker, CantShrinkTheMemoryThatTheDaemonReads) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  EXPECT_TRUE(follow(client, client.submit("shrink")).end.has_finished());
}

TEST_P(WorkerTrouble, ThriceFailsTheJobAndTheNextOneRenders) {
  // Later attempts have fewer tiles left, so its trouble has to come at once.
  std::string script = GetParam().script;
  if (script.back() == '5' || script == "crash 12")
    script = script.substr(0, script.find(' ')) + " 0";
  const auto job = client_.submit(script);
  const Story story = follow(client_, job);
  EXPECT_EQ(story.retries.size(), 2u);
  ASSERT_TRUE(story.end.has_failed()) << story.end.ShortDebugString();
  EXPECT_EQ(story.end.failed().kind(), v1::Failed::WORKER);
  EXPECT_EQ(story.end.failed().reason(),
            std::string("the worker was lost 3 times: ") + GetParam().reason);
  EXPECT_EQ(client_.summary(job).reason(), story.end.failed().reason());
  EXPECT_EQ(client_.summary(job).state(), v1::FAILED);
  EXPECT_EQ(worker_info(client_).last_exit(), GetParam().reason);
  client_.ping();
  EXPECT_TRUE(follow(client_, client_.submit("picture 64 48 16")).end.has_finished());
}

INSTANTIATE_TEST_SUITE_P(AWorkerThat, WorkerTrouble, testing::ValuesIn(troubles),
                         [](const auto& trouble) { return trouble.param.name; });

TEST(WorkerLoss, KilledFromOutsideLosesNoTile) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  const auto job = client.submit("gate 7 once");
  client.watch(job);
  int tiles = 0;
  while (tiles < 7) tiles += client.receive_event().has_tile();
  const v1::WorkerInfo before = worker_info(client);
  EXPECT_EQ(before.state(), "busy");
  ASSERT_EQ(::kill(static_cast<pid_t>(before.pid()), SIGKILL), 0);
  const auto retrying =
      client.receive_event_until([](auto& event) { return event.has_retrying(); });
  EXPECT_EQ(retrying.retrying().reason(), "the worker was lost: killed by signal 9 (Killed)");
  while (true) {
    const v1::JobEvent event = client.receive_event();
    tiles += event.has_tile();
    if (event.has_started()) {
      EXPECT_EQ(event.started().attempt(), 2u);
    }
    ASSERT_FALSE(event.has_planned());
    if (event.has_finished()) break;
  }
  EXPECT_EQ(tiles, 12);
  const v1::WorkerInfo after = worker_info(client);
  EXPECT_NE(after.pid(), before.pid());
  EXPECT_EQ(after.starts(), 2u);
  EXPECT_EQ(after.last_exit(), "killed by signal 9 (Killed)");
}

TEST(WorkerLoss, WhoChecksThePictureHasTheTilesOfEarlierWorkersToo) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  for (const std::string trouble : {"crash 5", "crash 12"}) {  // 12: nothing is left but the check
    client.watch(client.submit("verify once " + trouble));
    bool told = false;
    v1::JobEvent event;
    do {
      event = client.receive_event();
      told = told || event.progress().tiles_verified() == 3;
    } while (!ends(event));
    ASSERT_TRUE(event.has_finished()) << trouble << ": " << event.ShortDebugString();
    EXPECT_TRUE(event.finished().accuracy().kept()) << trouble;
    EXPECT_TRUE(told) << trouble;
  }
}

TEST(WorkerLoss, PingsAreAnsweredWhileAWorkerIsStopped) {
  Daemon daemon([](ServiceOptions& options) { options.worker.worker_timeout = minutes(1); });
  Client client(daemon.socket());
  Client other(daemon.socket());
  client.hello();
  other.hello();
  const auto job = client.submit("gate 3 once");
  client.watch(job);
  for (int tiles = 0; tiles < 3;) tiles += client.receive_event().has_tile();
  const auto worker = static_cast<pid_t>(worker_info(other).pid());
  ASSERT_EQ(::kill(worker, SIGSTOP), 0);
  for (int pings = 0; pings < 100; ++pings) other.ping();
  EXPECT_EQ(worker_info(other).starts(), 1u) << "it is still waited for";
  ASSERT_EQ(::kill(worker, SIGKILL), 0);
  const auto end = client.receive_event_until(ends);
  EXPECT_TRUE(end.has_finished()) << end.ShortDebugString();
}

TEST(WorkerLoss, AnIdleWorkerThatDiesIsReplaced) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  for (std::uint32_t starts = 1; starts <= 4; ++starts) {
    v1::WorkerInfo info;
    do info = worker_info(client);
    while (info.state() != "idle");
    EXPECT_EQ(info.starts(), starts);
    ASSERT_EQ(::kill(static_cast<pid_t>(info.pid()), SIGKILL), 0);
    while (worker_info(client).pid() == info.pid()) {
    }
  }
  v1::WorkerInfo info;
  do info = worker_info(client);
  while (info.state() != "idle");
  EXPECT_TRUE(follow(client, client.submit("picture 64 48 16")).end.has_finished());
}

TEST(WorkerLoss, WhereNobodyWillMendItJobsAreToldThatNoWorkerStarts) {
  Daemon daemon([](ServiceOptions& options) {
    options.worker.command.program = "/nonexistent/metamer-worker";
    options.worker.gives_up = true;
  });
  Client client(daemon.socket());
  client.hello();
  client.ping();
  const Story story = follow(client, client.submit("picture 64 48 16"));
  ASSERT_TRUE(story.end.has_failed());
  EXPECT_EQ(story.end.failed().kind(), v1::Failed::WORKER);
  EXPECT_EQ(story.end.failed().reason(),
            "no worker starts: can't start /nonexistent/metamer-worker: No such file or directory");
  EXPECT_GE(worker_info(client).starts(), 3u);
  EXPECT_EQ(worker_info(client).pid(), 0u);
}

TEST(WorkerLoss, JobsWaitAndSayWhyUntilAWorkerStarts) {
  Daemon daemon([](ServiceOptions& options) {
    std::ofstream(options.store.parent_path() / "no-start").put('x');
  });
  Client client(daemon.socket());
  client.hello();
  const auto first = client.submit("picture 64 48 16");
  client.watch(first);
  const auto held = client.receive_event_until(
      [](auto& event) { return event.has_queued() && !event.queued().reason().empty(); });
  EXPECT_EQ(held.queued().reason(), "no worker starts: exited with code 3");
  EXPECT_GE(worker_info(client).starts(), 3u);
  const auto second = client.submit("picture 64 48 16");
  for (const auto job : {first, second}) EXPECT_EQ(client.summary(job).state(), v1::QUEUED);
  EXPECT_EQ(client.summary(first).reason(), "no worker starts: exited with code 3");
  daemon.mend_start("no-start");
  client.receive_event_until(ends);
  client.watch(second);
  EXPECT_TRUE(client.receive_event_until(ends).has_finished());
  EXPECT_EQ(client.summary(first).state(), v1::FINISHED);
  EXPECT_EQ(client.summary(first).reason(), "");
}

TEST(WorkerLoss, AWorkerThatStartsAgainTakesTheQueueUp) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  daemon.spoil_start("no-start");
  const auto job = client.submit("crash 5 once");
  client.watch(job);
  client.receive_event_until([](auto& event) { return event.has_retrying(); });
  daemon.mend_start("no-start");
  EXPECT_TRUE(client.receive_event_until(ends).has_finished());
}

TEST(WorkerLoss, AWorkerThatBeatsAndIsNeverReadyIsEnded) {
  Daemon daemon([](ServiceOptions& options) {
    options.worker.worker_timeout = milliseconds(200);
    options.worker.gives_up = true;
    std::ofstream(options.store.parent_path() / "never-ready").put('x');
  });
  Client client(daemon.socket());
  client.hello();
  const Story story = follow(client, client.submit("picture 64 48 16"));
  ASSERT_TRUE(story.end.has_failed());
  EXPECT_EQ(story.end.failed().reason(), "no worker starts: was not ready within 0.2 s");
}

TEST(WorkerLoss, APlanThatLiesIsNotBelieved) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  const Story story = follow(client, client.submit("picture 70000 70000 16"));
  ASSERT_TRUE(story.end.has_failed());
  EXPECT_EQ(
      story.end.failed().reason(),
      "the worker was lost 3 times: sent a plan that can't be: a picture of 70000 x 70000 pixels");
}

TEST(WorkerLoss, AFailedSceneIsNotTheWorkersLoss) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  const Story story = follow(client, client.submit("fail"));
  EXPECT_TRUE(story.retries.empty());
  ASSERT_TRUE(story.end.has_failed());
  EXPECT_EQ(story.end.failed().kind(), v1::Failed::BAD_INPUT);
  EXPECT_EQ(story.end.failed().problem(0).message(), "it fails");
  EXPECT_EQ(worker_info(client).starts(), 1u);
}

}  // namespace metamer::service::test
