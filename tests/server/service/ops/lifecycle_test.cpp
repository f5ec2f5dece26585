// How the daemon ends, and how it takes another configuration.

#include "server/service/ops/lifecycle.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <fstream>

#include "../client.h"
#include "../program.h"
#include "server/service/ops/folders.h"
#include "server/service/ops/option_value.h"

namespace metamer::service::test {

namespace {

class Lifetime : public testing::Test {
 protected:
  TemporaryFolder folder_ = TemporaryFolder::make().value();
  std::filesystem::path path() const { return folder_.path() / "socket"; }
  std::vector<std::string> options(std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"--listen", "unix:" + path().string(), "--parent-fd", "3"});
    return more;
  }
  /// Watches a finished picture of which more is on its way than the socket holds, and reads none.
  static std::uint64_t watch_much(Client& client) {
    client.hello();
    const auto job = client.submit("picture 3840 2160 256");
    client.watch(job, 0, false);
    client.receive_event_until([](auto& event) { return event.has_finished(); });
    return client.watch(job);
  }
};

/// What a service manager hears.
class NotifySocket {
 public:
  explicit NotifySocket(const std::filesystem::path& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    EXPECT_EQ(::bind(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  }
  ~NotifySocket() { ::close(fd_); }
  NotifySocket(const NotifySocket&) = delete;

  /// Whether this comes within 10 s; what comes before is thrown away.
  bool hears(const std::string& wanted) {
    pollfd waiting{fd_, POLLIN, 0};
    while (::poll(&waiting, 1, 10'000) == 1) {
      char text[4096];
      const ssize_t size = ::recv(fd_, text, sizeof text, 0);
      if (size > 0 && std::string(text, static_cast<std::size_t>(size)).starts_with(wanted))
        return true;
    }
    return false;
  }

 private:
  int fd_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
};

}  // namespace

TEST_F(Lifetime, WatchersAreToldUnderTheirRequestOnceTheyHaveWhatHappened) {
  Program program(folder_.path(), options());
  ASSERT_EQ(program.ready(), "ready\n");
  Client client(path()), idle(path());
  client.hello();
  idle.hello();
  const auto job = client.submit("stall 3");
  const auto watch = client.watch(job);
  for (int tiles = 0; tiles < 3;) tiles += client.receive_event().has_tile();
  program.signal(SIGTERM);
  const auto told = client.receive();
  ASSERT_TRUE(told);
  EXPECT_EQ(told->request_id(), watch);
  EXPECT_EQ(told->error().code(), v1::Error::CLOSING);
  EXPECT_EQ(told->error().message(), "job " + std::to_string(job) + ": the server ends");
  EXPECT_TRUE(client.closed_by_server());
  EXPECT_TRUE(idle.closed_by_server());
  EXPECT_EQ(program.wait(), 0);
  EXPECT_EQ(program.log().find("can't accept"), std::string::npos) << program.log();
}

TEST_F(Lifetime, AServerThatEndsTakesNoJobsAndStillSendsWhatIsOnItsWay) {
  Program program(folder_.path(), options({"--drain-seconds", "3600"}));
  ASSERT_EQ(program.ready(), "ready\n");
  Client client(path());
  watch_much(client);
  program.signal(SIGTERM);
  ASSERT_TRUE(program.says("ending for signal 15"));
  v1::Envelope submit;
  submit.mutable_submit()->set_scene_sha256(std::string(32, 'x'));
  EXPECT_EQ(client.ask(submit).error().code(), v1::Error::CLOSING);
  v1::Envelope view;
  view.mutable_open_view()->set_scene_sha256(std::string(32, 'x'));
  EXPECT_EQ(client.ask(view).error().code(), v1::Error::CLOSING);
  int tiles = 0;
  client.receive_event_until([&](auto& event) {
    tiles += event.has_tile();
    return event.has_finished();
  });
  EXPECT_EQ(tiles, 135);
  EXPECT_TRUE(client.closed_by_server());
  EXPECT_EQ(program.wait(), 0);
}

TEST_F(Lifetime, WhoDoesNotReadHoldsItUpForTheTimeThatWasSetAndNoLonger) {
  Program program(folder_.path(), options({"--drain-seconds", "0.05"}));
  ASSERT_EQ(program.ready(), "ready\n");
  Client client(path());
  watch_much(client);
  program.signal(SIGTERM);
  EXPECT_EQ(program.wait(), 0);
}

TEST_F(Lifetime, ASecondSignalEndsItAtOnce) {
  Program program(folder_.path(), options({"--drain-seconds", "3600"}));
  ASSERT_EQ(program.ready(), "ready\n");
  Client client(path());
  watch_much(client);
  program.signal(SIGTERM);
  ASSERT_TRUE(program.says("ending for signal 15"));
  program.signal(SIGTERM);
  EXPECT_EQ(program.wait(), 0);
  EXPECT_NE(program.log().find("ending at once for signal 15"), std::string::npos);
}

TEST_F(Lifetime, ASignalHasTheConfigurationReadAgain) {
  const std::string file = (folder_.path() / "m.toml").string();
  std::ofstream(file) << "[limits]\nsession-watches = 3\n";
  Program program(folder_.path(), options({"--config", file}));
  ASSERT_EQ(program.ready(), "ready\n");
  Client client(path());
  EXPECT_EQ(client.hello().limits().watches(), 3u);

  std::ofstream(file) << "[limits]\nsession-watches = 5\n[workers]\nthreads = 3\n";
  program.signal(SIGHUP);
  ASSERT_TRUE(program.says("needs a restart: threads")) << program.log();
  EXPECT_NE(program.log().find("configuration read again: 1 changed (session-watches)"),
            std::string::npos)
      << program.log();
  EXPECT_EQ(client.info().limits().watches(), 5u);

  std::ofstream(file) << "[limits]\nsession-watches = 500\n";
  program.signal(SIGHUP);
  ASSERT_TRUE(program.says("the configuration stays as it was")) << program.log();
  EXPECT_NE(program.log().find(file + ":2:19: error: session-watches: expected a whole number"),
            std::string::npos)
      << program.log();
  EXPECT_EQ(client.info().limits().watches(), 5u);
}

TEST(TakingOver, EachOptionEitherChangesOrNeedsARestart) {
  for (const Option& option : all_options()) {
    if (option.section.empty()) continue;
    SCOPED_TRACE(option.name);
    Settings settings, fresh;
    const auto before = toml_text(option, settings);
    for (const OptionValue& value :
         {OptionValue(true), OptionValue(std::int64_t{7}), OptionValue("7MiB"),
          OptionValue("127.0.0.1:7"), OptionValue("reference"), OptionValue("debug"),
          OptionValue("json"), OptionValue("slurm"), OptionValue("avx2"), OptionValue("0660"),
          OptionValue(std::vector<std::string>{"127.0.0.1:7"})})
      if (service::set(option, fresh, value) && toml_text(option, fresh) != before) break;
    const TakenOver taken = take_over(settings, fresh);
    const std::vector<std::string> named = {option.name}, none;
    EXPECT_EQ(taken.changed, option.reloads ? named : none);
    EXPECT_EQ(taken.needs_restart, option.reloads ? none : named);
    EXPECT_EQ(toml_text(option, settings) == toml_text(option, fresh), option.reloads);
  }
}

TEST_F(Lifetime, TheServiceManagerHearsOfEachStep) {
  const auto socket = folder_.path() / "notify";
  NotifySocket manager(socket);
  Program program(folder_.path(), options(),
                  {"NOTIFY_SOCKET=" + socket.string(), "WATCHDOG_USEC=40000"});
  ASSERT_EQ(program.ready(), "ready\n");
  EXPECT_TRUE(manager.hears("READY=1"));
  EXPECT_TRUE(manager.hears("WATCHDOG=1"));
  EXPECT_TRUE(manager.hears("STATUS=0 running, 0 queued, 0 sessions"));
  EXPECT_TRUE(manager.hears("WATCHDOG=1"));
  program.signal(SIGHUP);
  EXPECT_TRUE(manager.hears("RELOADING=1\nMONOTONIC_USEC="));
  EXPECT_TRUE(manager.hears("READY=1"));
  program.signal(SIGTERM);
  EXPECT_TRUE(manager.hears("STOPPING=1\nEXTEND_TIMEOUT_USEC=20000000"));  // 10 s of drain-seconds
  EXPECT_EQ(program.wait(), 0);
}

}  // namespace metamer::service::test
