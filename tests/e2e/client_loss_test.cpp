// Jobs outlive their clients; private servers do not.
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>

#include "running_job.h"

namespace metamer::test {
namespace {

TEST(ClientKilledInMidStream, LeavesTheJobRunning) {
  const Daemon daemon(Daemon::Listens::unix_socket, {"--worker-timeout", "60"});
  const Folder folder;
  const std::string scene = folder.write("long.txtpb", long_scene());

  // Kill a client while tiles stream to it.
  const auto client = daemon.start({"render", scene, "-o", folder / "never.exr"});
  ASSERT_TRUE(client->line_err(" %, "));
  HeldWorkers held(daemon);
  client->signal(SIGKILL);
  EXPECT_EQ(client->wait().code, 128 + SIGKILL);
  EXPECT_FALSE(std::filesystem::exists(folder / "never.exr"));
  const std::string job = "1";
  EXPECT_EQ(daemon.job_state(job), "running");

  // Pick up from a number: what comes is what a watch from the beginning has from there on.
  const std::uint64_t from = daemon.json({"jobs"})["jobs"][0]["last_sequence"];
  EXPECT_GT(from, 3u);
  const auto watcher = daemon.start({"watch", job, "--json", "--from", std::to_string(from)});
  held.release();
  const Ended rest = watcher->wait();
  EXPECT_EQ(rest.code, 0) << rest.err;
  const Json first = parse_document(rest.out.substr(0, rest.out.find('\n')));
  EXPECT_GE(first["sequence"].get<std::uint64_t>(), from);
  EXPECT_NE(rest.out.find("\"finished\""), std::string::npos);

  // Its picture equals that of an undisturbed run.
  const std::string fetched = folder / "fetched.exr";
  const std::string undisturbed = folder / "undisturbed.exr";
  EXPECT_EQ(daemon.metamer({"fetch", job, "-o", fetched, "--exr", "xyz"}).code, 0);
  EXPECT_EQ(daemon.metamer({"render", scene, "-o", undisturbed, "--exr", "xyz"}).code, 0);
  expect_same_pixels(read_exr(fetched), read_exr(undisturbed), "after a killed client");
}

TEST(ClientKilled, TakesItsPrivateServerAlongAndLeavesNothingBehind) {
  const Folder folder;
  const Folder runtime;
  const std::string scene = folder.write("endless.txtpb", endless_scene());
  ProcessOptions options;
  options.environment = {{"XDG_RUNTIME_DIR", runtime.path()}, {"TMPDIR", runtime.path()}};
  Process client({"metamer", "render", scene, "-o", folder / "never.png"}, options);
  ASSERT_TRUE(client.line_err("planned: "));

  // Know its daemon and the daemon's worker before it is too late to ask.
  const std::vector<pid_t> daemons = children_of(client.pid());
  ASSERT_EQ(daemons.size(), 1u);
  const std::vector<pid_t> workers = children_of(daemons[0]);
  ASSERT_FALSE(workers.empty());
  const OtherProcess daemon(daemons[0]);
  const OtherProcess worker(workers[0]);

  client.signal(SIGKILL);
  client.wait();
  EXPECT_TRUE(daemon.ends());
  EXPECT_TRUE(worker.ends());
  EXPECT_TRUE(std::filesystem::is_empty(runtime.path()));
}

TEST(ClientThatEnds, TakesItsPrivateServerAlong) {
  const Folder folder;
  const Folder runtime;
  const std::string scene = folder.write("small.txtpb", small_scene());
  ProcessOptions options;
  options.environment = {{"XDG_RUNTIME_DIR", runtime.path()}, {"TMPDIR", runtime.path()}};
  Process client({"metamer", "render", scene, "-o", folder / "a.png"}, options);
  ASSERT_TRUE(client.line_err("planned: "));
  const std::vector<pid_t> daemons = children_of(client.pid());
  ASSERT_EQ(daemons.size(), 1u);
  const OtherProcess daemon(daemons[0]);
  EXPECT_EQ(client.wait().code, 0);
  EXPECT_TRUE(daemon.ends());
  EXPECT_TRUE(std::filesystem::is_empty(runtime.path()));
}

}  // namespace
}  // namespace metamer::test
