// A stranger who listens where a server is expected.

#include "client/session/server_owner.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>

#include "client/session/session.h"

namespace metamer::client {

namespace {

constexpr uid_t nobody = 65534;

/// A folder of ours in /tmp, with a socket's place in it.
class ServerOwner : public testing::Test {
 protected:
  void SetUp() override {
    if (::geteuid() != 0) GTEST_SKIP() << "only root can be two users";
    std::string pattern = "/tmp/metamer-owner-XXXXXX";
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    ASSERT_EQ(::chmod(folder_.c_str(), 0755), 0);
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }
  std::filesystem::path socket() const { return folder_ / "socket"; }
  static std::string refusal(const Result<void>& result) {
    return result ? "" : result.error().message;
  }

  std::filesystem::path folder_;
};

/// Listens as `user`, and sends what it then receives, if anything, to `report`.
pid_t listen_as(uid_t user, const std::filesystem::path& path, int ready, int report) {
  const pid_t pid = ::fork();
  if (pid != 0) return pid;
  ::alarm(20);
  if (::setuid(user) != 0) ::_exit(1);
  const int listener = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
  if (::bind(listener, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) ::_exit(2);
  if (::listen(listener, 1) != 0 || ::write(ready, "x", 1) != 1) ::_exit(3);
  const int client = ::accept(listener, nullptr, nullptr);
  char byte = 0;
  const bool heard = ::read(client, &byte, 1) > 0;
  const bool told = ::write(report, heard ? "1" : "0", 1) == 1;
  ::_exit(told ? 0 : 4);
}

}  // namespace

TEST_F(ServerOwner, AnImpostorIsToldNothing) {
  ASSERT_EQ(::chmod(folder_.c_str(), 01777), 0);  // as /tmp is
  int ready[2];
  int report[2];
  ASSERT_EQ(::pipe(ready), 0);
  ASSERT_EQ(::pipe(report), 0);
  const pid_t impostor = listen_as(nobody, socket(), ready[1], report[1]);
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);

  boost::asio::io_context loop;
  std::optional<SessionError> failure;
  const auto client = [&]() -> boost::asio::awaitable<void> {
    ConnectLimits limits;
    limits.welcome = std::chrono::seconds(2);
    auto session = co_await Session::connect("unix:" + socket().string(), limits);
    if (!session) failure = session.error();
  };
  boost::asio::co_spawn(loop, client(), boost::asio::detached);
  loop.run();

  ASSERT_EQ(::read(report[0], &byte, 1), 1);
  EXPECT_EQ(byte, '0') << "the impostor heard something";
  ::waitpid(impostor, nullptr, 0);
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->kind, SessionError::Kind::no_server);
  EXPECT_EQ(failure->message, "uid 65534 listens at " + socket().string() +
                                  ", where neither root nor you have let that user; nothing was "
                                  "sent");
  for (const int end : {ready[0], ready[1], report[0], report[1]}) ::close(end);
}

TEST_F(ServerOwner, WeAndRootMayListenAnywhere) {
  EXPECT_TRUE(check_server_owner(::geteuid(), "/tmp/anything"));
  EXPECT_TRUE(check_server_owner(0, "/tmp/anything"));
}

TEST_F(ServerOwner, AFolderThatAnybodyMayHaveMadeProvesNothing) {
  // /tmp/metamer-owner-XXXXXX was made by nobody, as far as its owner tells.
  ASSERT_EQ(::chown(folder_.c_str(), nobody, nobody), 0);
  EXPECT_NE(refusal(check_server_owner(nobody, socket())), "");
}

TEST_F(ServerOwner, AUserToWhomRootGaveTheFolderMayListenThere) {
  // Not below /tmp, where others make entries.
  std::string pattern = "/run/metamer-owner-XXXXXX";
  ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
  const std::filesystem::path given = pattern;
  ASSERT_EQ(::chown(given.c_str(), nobody, nobody), 0);
  EXPECT_EQ(refusal(check_server_owner(nobody, given / "socket")), "");
  EXPECT_NE(refusal(check_server_owner(nobody + 1, given / "socket")), "");
  std::filesystem::remove_all(given);
  EXPECT_NE(refusal(check_server_owner(nobody, given / "socket")), "") << "it is gone";
}

}  // namespace metamer::client
