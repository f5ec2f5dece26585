// The program itself: its options, its ends and its exit codes.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "client.h"
#include "common/digest.h"
#include "server/service/folders.h"

namespace metamer::service::test {

namespace {

namespace fs = std::filesystem;

/// A metamerd with the fake worker, stderr in a file, and one end of a socket pair as its
/// descriptor 3.
class Program {
 public:
  explicit Program(const fs::path& folder, std::vector<std::string> options)
      : log_(folder / "log") {
    std::vector<std::string> words = {METAMER_BIN "/metamerd", "--worker",
                                      METAMER_BIN "/metamer-fake-worker"};
    words.insert(words.end(), options.begin(), options.end());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const std::string temporary = "TMPDIR=" + folder.string();
    char* environment[] = {const_cast<char*>(temporary.c_str()), nullptr};

    int pair[2];
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair), 0);
    pair_end_ = ::fcntl(pair[0], F_DUPFD_CLOEXEC, 10);
    const int theirs = ::fcntl(pair[1], F_DUPFD_CLOEXEC, 10);
    ::close(pair[0]);
    ::close(pair[1]);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 2, log_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, theirs, 3);
    EXPECT_EQ(posix_spawn(&pid_, arguments[0], &actions, nullptr, arguments.data(), environment),
              0);
    posix_spawn_file_actions_destroy(&actions);
    ::close(theirs);
  }
  ~Program() {
    hang_up();
    if (pid_ > 0) wait();
  }
  Program(const Program&) = delete;

  /// What the daemon says on that; empty when it ends first.
  std::string ready() {
    char line[16];
    const ssize_t got = ::recv(pair_end_, line, sizeof line, 0);
    return got > 0 ? std::string(line, static_cast<std::size_t>(got)) : "";
  }
  void hang_up() {
    if (pair_end_ >= 0) ::close(pair_end_);
    pair_end_ = -1;
  }
  /// Page faults so far that needed no disk.
  long faults() const {
    std::ifstream file("/proc/" + std::to_string(pid_) + "/stat");
    std::string text{std::istreambuf_iterator<char>(file), {}};
    std::istringstream fields(text.substr(text.rfind(')') + 2));
    std::string skipped;
    for (int i = 3; i < 10; ++i) fields >> skipped;  // minflt is the tenth, see proc(5)
    long faults = 0;
    fields >> faults;
    return faults;
  }
  void signal(int number) { ::kill(pid_, number); }
  int wait() {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  std::string log() const {
    std::ifstream file(log_);
    return {std::istreambuf_iterator<char>(file), {}};
  }

 private:
  fs::path log_;
  int pair_end_ = -1;
  pid_t pid_ = -1;
};

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
    EXPECT_EQ(program.wait(), 0);
    EXPECT_TRUE(client.closed_by_server());
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
      program.log().find("\"nonsense\" is no endpoint: expected unix:PATH, HOST:PORT or PORT"),
      std::string::npos)
      << program.log();
}

}  // namespace metamer::service::test
