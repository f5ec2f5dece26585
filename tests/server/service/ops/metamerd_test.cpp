// The program itself: its options, its ends and its exit codes.

#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <fstream>

#include "../../../common/wire/certificates.h"
#include "../client.h"
#include "../program.h"
#include "common/digest.h"
#include "server/service/ops/folders.h"

namespace metamer::service::test {

namespace {

namespace fs = std::filesystem;

class Metamerd : public testing::Test {
 protected:
  TemporaryFolder folder_ = TemporaryFolder::make().value();
  fs::path path() const { return folder_.path() / "socket"; }
  std::vector<std::string> private_options() const {
    return {"--listen", "unix:" + path().string(), "--parent-fd", "3"};
  }
  /// Everything but the log.
  std::size_t left_behind() const {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      const std::string name = entry.path().filename();
      count += name != "log" && name != "started-gl" && !name.starts_with("attempted");
    }
    return count;
  }
  pid_t worker() const {
    Client client(path());
    client.hello();
    v1::Envelope message;
    message.mutable_get_info();
    return static_cast<pid_t>(client.ask(message).info().worker(0).pid());
  }
};

}  // namespace

TEST_F(Metamerd, SaysReadyAndEndsWithItsParent) {
  Program program(folder_.path(), private_options());
  ASSERT_EQ(program.ready(), "ready\n");
  const pid_t pid = worker();
  EXPECT_EQ(::kill(pid, 0), 0);
  program.hang_up();
  EXPECT_EQ(program.wait(), 0);
  EXPECT_EQ(::kill(pid, 0), -1);
  EXPECT_EQ(left_behind(), 0u);
}

TEST_F(Metamerd, EndsOnSignalsAndLeavesNothingBehind) {
  for (const int signal : {SIGTERM, SIGINT}) {
    Program program(folder_.path(), private_options());
    ASSERT_EQ(program.ready(), "ready\n");
    Client client(path());
    client.hello();
    client.watch(client.submit("stall 3"));
    for (int tiles = 0; tiles < 3;) tiles += client.receive_event().has_tile();
    program.signal(signal);
    EXPECT_EQ(client.receive()->error().code(), v1::Error::CLOSING);
    EXPECT_TRUE(client.closed_by_server());
    EXPECT_EQ(program.wait(), 0);
    EXPECT_EQ(left_behind(), 0u);
  }
}

TEST_F(Metamerd, ItsStoreIsKeptWhenItHasOne) {
  auto options = private_options();
  options.insert(options.end(), {"--store", (folder_.path() / "store").string()});
  for (const std::size_t missing : {1u, 0u}) {
    Program program(folder_.path(), options);
    ASSERT_EQ(program.ready(), "ready\n");
    Client client(path());
    client.hello();
    v1::Envelope offer;
    offer.mutable_offer_assets()->add_sha256(std::string(to_bytes(sha256("kept"))));
    EXPECT_EQ(client.ask(offer).missing_assets().sha256_size(), static_cast<int>(missing));
    client.upload({"kept"});
  }
}

TEST_F(Metamerd, AJobsNumberDoesNotComeAgainAfterARestart) {
  std::uint64_t last = 0;
  for (int start = 0; start < 3; ++start) {
    Program program(folder_.path(), private_options());
    ASSERT_EQ(program.ready(), "ready\n");
    Client client(path());
    client.hello();
    const std::uint64_t first = client.submit("picture 64 48 16");
    EXPECT_GT(first, last);
    v1::Envelope watch;
    watch.mutable_watch()->set_job_id(last);
    EXPECT_EQ(client.ask(watch).error().message(), "there is no job " + std::to_string(last));
    last = client.submit("picture 64 48 16");
    EXPECT_EQ(last, first + 1);
    EXPECT_LT(last, std::uint64_t{1} << 53);
    program.hang_up();
    EXPECT_EQ(program.wait(), 0);
  }
}

TEST_F(Metamerd, TheFirstJobsNumberCanBeChosen) {
  auto options = private_options();
  options.insert(options.end(), {"--first-job", "700"});
  Program program(folder_.path(), options);
  ASSERT_EQ(program.ready(), "ready\n");
  Client client(path());
  client.hello();
  EXPECT_EQ(client.submit("picture 64 48 16"), 700u);
}

TEST_F(Metamerd, NamesForgeNoLinesOfItsLog) {
  Program program(folder_.path(), private_options());
  ASSERT_EQ(program.ready(), "ready\n");
  {
    Client client(path());
    v1::Envelope message;
    message.mutable_hello()->set_protocol_version(1);
    message.mutable_hello()->set_client("x\n[error] forged\x1b[2J");
    ASSERT_TRUE(client.ask(message).has_welcome());
    message.mutable_submit()->set_scene_sha256(client.upload({"picture 8 8 8"})[0]);
    message.mutable_submit()->set_name(
        "y\r\n[error] forged\xC2\x9B"
        "2J");
    client.watch(client.ask(message).submitted().job_id());
    client.receive_event_until([](auto& event) { return event.has_finished(); });
  }
  program.hang_up();
  EXPECT_EQ(program.wait(), 0);
  const std::string log = program.log();
  EXPECT_NE(log.find("x?[error] forged?[2J"), std::string::npos) << log;
  EXPECT_NE(log.find("(y??[error] forged?2J) started"), std::string::npos) << log;
  EXPECT_EQ(log.find('\x1b'), std::string::npos);
  EXPECT_EQ(log.find("\n[error]"), std::string::npos);
}

// With the allocator that is delivered: sanitizers bring their own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_F(Metamerd, APicturesTilesTakeMemoryThatIsThereAlready) {
  Program program(folder_.path(), private_options());
  ASSERT_EQ(program.ready(), "ready\n");
  Client client(path());
  client.hello();
  const auto job = client.submit("picture 3840 2160 256");
  const auto fetch = [&] {
    client.watch(job);
    client.receive_event_until([](auto& event) { return event.has_finished(); });
  };
  fetch();
  const long before = program.faults();
  fetch();
  // 135 tiles of 192 pages, which go through several copies.
  EXPECT_LT(program.faults() - before, 2000);
}
#endif

TEST_F(Metamerd, AnAddressInUseIsAFailureWithItsReason) {
  Program first(folder_.path(), private_options());
  ASSERT_EQ(first.ready(), "ready\n");
  const TemporaryFolder other = TemporaryFolder::make().value();
  Program second(other.path(), private_options());
  EXPECT_EQ(second.wait(), 1);
  EXPECT_NE(second.log().find("can't listen on unix:" + path().string() +
                              ": another server listens there"),
            std::string::npos)
      << second.log();
  Client(path()).hello();
}

TEST_F(Metamerd, WrongUsageHasItsOwnExitCode) {
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--no-such-option"},
                                                  {"--listen", "nonsense"},
                                                  {"--threads", "1000"},
                                                  {"--first-job", "0"},
                                                  {"--worker-timeout", "-1"},
                                                  {"--log-level", "loud"}}) {
    EXPECT_EQ(Program(folder_.path(), options).wait(), 2) << options[0];
  }
  Program program(folder_.path(), {"--listen", "nonsense"});
  EXPECT_EQ(program.wait(), 2);
  EXPECT_NE(
      program.log().find(
          "\"nonsense\" is no endpoint: expected unix:PATH, HOST:PORT, PORT or tls:HOST:PORT"),
      std::string::npos)
      << program.log();
}

TEST_F(Metamerd, TheCommandLineOverridesItsFile) {
  const std::string file = (folder_.path() / "m.toml").string();
  std::ofstream(file) << "[service]\nlisten = [\"unix:" << path().string()
                      << "\"]\n[store]\nfirst-job = 900\n";
  for (const std::uint64_t first : {900u, 700u}) {
    std::vector<std::string> options = {"--config", file, "--parent-fd", "3"};
    if (first == 700) options.insert(options.end(), {"--first-job", "700"});
    Program program(folder_.path(), options);
    ASSERT_EQ(program.ready(), "ready\n") << program.log();
    Client client(path());
    client.hello();
    EXPECT_EQ(client.submit("picture 64 48 16"), first);
  }
}

TEST_F(Metamerd, AWrongFileIsAnErrorOfUsageWithItsPlace) {
  const std::string file = (folder_.path() / "m.toml").string();
  std::ofstream(file) << "[log]\nlog-levle = \"info\"\n";
  for (const char* how : {"--check-config", "--config"}) {
    Program program(folder_.path(), {how, file});
    EXPECT_EQ(program.wait(), 2) << how;
    EXPECT_EQ(program.log(), file +
                                 ":2:1: error: [log] has no option \"log-levle\"; did you mean "
                                 "\"log-level\"?\n");
  }
  std::ofstream(file) << "[log]\nlog-level = \"info\"\n";
  EXPECT_EQ(Program(folder_.path(), {"--check-config", file}).wait(), 0);
  for (const std::string& missing : {file + "-not", folder_.path().string()}) {
    Program program(folder_.path(), {"--check-config", missing});
    EXPECT_EQ(program.wait(), 2);
    EXPECT_NE(program.log().find(missing + ": error: can't be read"), std::string::npos)
        << program.log();
  }
}

TEST_F(Metamerd, SettingsThatCantBeCarriedOutTogetherAreErrorsOfUsage) {
  const std::string file = (folder_.path() / "m.toml").string();
  const auto set = [&](const std::string& text) { std::ofstream(file) << "[service]\n" << text; };
  const std::pair<const char*, const char*> cases[] = {
      {"listen = [\"tls:0.0.0.0:0\"]", "error: listen: TLS needs --tls-cert and --tls-key"},
      {"listen = [\"tls:127.0.0.1:0\"]\ntls-cert = \"/no.pem\"\ntls-key = \"/no.key\"",
       "error: /no.pem can't be read: No such file or directory"},
      {"listen = [\"0.0.0.0:0\"]", "could be read on the way. Listen on tls:0.0.0.0:0, or say"},
      {"listen = [\"[::]:0\"]", "could be read on the way. Listen on tls:[::]:0, or say"},
      {"socket-group = \"no-such-group\"", "socket-group: there is no group \"no-such-group\""}};
  for (const auto& [text, complaint] : cases) {
    set(text);
    for (const char* how : {"--check-config", "--config"}) {
      Program program(folder_.path(), {how, file});
      EXPECT_EQ(program.wait(), 2) << how << " " << text;
      EXPECT_NE(program.log().find(complaint), std::string::npos) << program.log();
    }
  }
  for (const char* text : {"listen = [\"127.0.0.1:0\", \"[::1]:0\", \"unix:/x\"]",
                           "listen = [\"0.0.0.0:0\"]\ninsecure = true"}) {
    set(text);
    Program program(folder_.path(), {"--check-config", file});
    EXPECT_EQ(program.wait(), 0) << program.log();
  }
}

TEST_F(Metamerd, AKeyThatOthersMayReadIsToldOf) {
  wire::test::Certificates certificates;
  const wire::TlsIdentity server = certificates.sign("server", "DNS:localhost");
  const std::string file = (folder_.path() / "m.toml").string();
  std::ofstream(file) << "[service]\nlisten = [\"tls:127.0.0.1:0\"]\ntls-cert = "
                      << server.certificate << "\ntls-key = " << server.key << "\n";
  for (const auto& [mode, told] : {std::pair(0400, false), std::pair(0640, true)}) {
    fs::permissions(server.key, static_cast<fs::perms>(mode));
    Program program(folder_.path(), {"--check-config", file});
    EXPECT_EQ(program.wait(), 0) << program.log();
    EXPECT_EQ(
        program.log().find(server.key.string() + " may be read by others") != std::string::npos,
        told)
        << program.log();
  }
}

TEST_F(Metamerd, ADiskThatIsSmallerThanWhatMayLieThereIsToldOf) {
  const std::string file = (folder_.path() / "m.toml").string();
  for (const auto& [bytes, told] : {std::pair("1MiB", false), std::pair("1PiB", true)}) {
    std::ofstream(file) << "[store]\nstate = " << folder_.path() << "\nkeep-bytes = \"1MiB\"\n"
                        << "store-bytes = \"" << bytes << "\"\n";
    Program program(folder_.path(), {"--check-config", file});
    EXPECT_EQ(program.wait(), 0) << program.log();
    EXPECT_EQ(program.log().find("store-bytes and keep-bytes come to") != std::string::npos, told)
        << program.log();
  }
}

}  // namespace metamer::service::test
