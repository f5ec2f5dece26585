#include "common/wire/endpoint.h"

#include <grp.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <filesystem>
#include <fstream>

namespace metamer::wire {

namespace {

namespace fs = std::filesystem;

class EndpointFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "endpoint-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  void TearDown() override { fs::remove_all(folder_); }
  Endpoint endpoint() const { return parse_endpoint("unix:" + path().string()).value(); }
  fs::path path() const { return folder_ / "socket"; }
  asio::io_context context_;
  asio::any_io_executor executor() { return context_.get_executor(); }
  /// Why one can't connect; empty where one can.
  std::string refusal(const Endpoint& endpoint) {
    std::string result;
    const auto attempt = [&]() -> asio::awaitable<void> {
      const auto socket = co_await connect(endpoint);
      if (!socket) result = socket.error().message;
    };
    asio::co_spawn(context_, attempt(), asio::detached);
    context_.restart();
    context_.run();
    return result;
  }
  fs::path folder_;
};

std::string error_of(const std::string& text) {
  const auto endpoint = parse_endpoint(text);
  return endpoint ? "none" : endpoint.error().message;
}

}  // namespace

TEST(Endpoint, IsReadAndWrittenAlike) {
  for (const char* text :
       {"unix:/run/user/1000/metamerd.sock", "unix:socket", "127.0.0.1:7777", "localhost:1",
        "[::1]:65535", "tls:render.example.org:7878", "tls:[::1]:1"}) {
    EXPECT_EQ(to_string(parse_endpoint(text).value()), text);
  }
  EXPECT_EQ(to_string(parse_endpoint("7777").value()), "127.0.0.1:7777");
  EXPECT_EQ(to_string(parse_endpoint("tls:7777").value()), "tls:127.0.0.1:7777");
}

TEST(Endpoint, SaysWhatWasExpected) {
  EXPECT_EQ(error_of(""),
            "\"\" is no endpoint: expected unix:PATH, HOST:PORT, PORT or tls:HOST:PORT");
  EXPECT_EQ(error_of("host"),
            "\"host\" is no endpoint: expected unix:PATH, HOST:PORT, PORT or tls:HOST:PORT");
  EXPECT_EQ(error_of(":80"),
            "\":80\" is no endpoint: expected unix:PATH, HOST:PORT, PORT or tls:HOST:PORT");
  EXPECT_EQ(error_of("host:"),
            "\"host:\" is no endpoint: expected unix:PATH, HOST:PORT, PORT or tls:HOST:PORT");
  EXPECT_EQ(error_of("host:-1"),
            "\"host:-1\" is no endpoint: expected unix:PATH, HOST:PORT, PORT or tls:HOST:PORT");
  EXPECT_EQ(error_of("65536"), "\"65536\" is no endpoint: a port is at most 65535");
  EXPECT_EQ(error_of("::1:80"),
            "\"::1:80\" is no endpoint: an IPv6 address needs brackets, as in [::1]:7777");
  EXPECT_EQ(error_of("tls:unix:x"),
            "\"tls:unix:x\" is no endpoint: expected unix:PATH, HOST:PORT, PORT or tls:HOST:PORT");
  EXPECT_EQ(error_of("unix:"), "\"unix:\" is no endpoint: the path after unix: is empty");
  const std::string path(108, 'p');
  EXPECT_EQ(error_of("unix:" + path), "\"unix:" + path +
                                          "\" is no endpoint: the path has 108 bytes, a Unix "
                                          "socket's has at most 107");
}

TEST_F(EndpointFiles, ASocketsModeAndGroupAreThoseAskedFor) {
  const gid_t group = ::getgid();
  const struct group* known = ::getgrgid(group);
  ASSERT_TRUE(known);
  const auto acceptor = Acceptor::listen(executor(), endpoint(), {0660, known->gr_name}).value();
  struct stat status {};
  ASSERT_EQ(::stat(path().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777u, 0660u);
  EXPECT_EQ(status.st_gid, group);
  EXPECT_TRUE(acceptor.is_local());
}

TEST_F(EndpointFiles, AGroupThatDoesNotExistIsSaid) {
  EXPECT_EQ(Acceptor::listen(executor(), endpoint(), {0660, "no such"}).error().message,
            "can't listen on " + to_string(endpoint()) + ": there is no group \"no such\"");
}

TEST_F(EndpointFiles, OnlyTheLoopbackIsLocal) {
  const auto is_local = [&](const char* text) {
    return Acceptor::listen(executor(), parse_endpoint(text).value()).value().is_local();
  };
  EXPECT_TRUE(is_local("0"));
  EXPECT_TRUE(is_local("127.0.0.9:0"));
  EXPECT_TRUE(is_local("localhost:0"));
  EXPECT_FALSE(is_local("0.0.0.0:0"));
}

TEST_F(EndpointFiles, ASocketIsItsOwnersAloneAndGoesWithItsListener) {
  {
    const auto acceptor = Acceptor::listen(executor(), endpoint()).value();
    struct stat status {};
    ASSERT_EQ(::stat(path().c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0600u);
    EXPECT_EQ(refusal(endpoint()), "");
  }
  EXPECT_FALSE(fs::exists(path()));
  EXPECT_EQ(refusal(endpoint()),
            "can't connect to unix:" + path().string() + ": No such file or directory");
}

TEST_F(EndpointFiles, ALiveSocketIsInUseAndAStaleOneIsReplaced) {
  {
    const auto acceptor = Acceptor::listen(executor(), endpoint()).value();
    EXPECT_EQ(Acceptor::listen(executor(), endpoint()).error().message,
              "can't listen on unix:" + path().string() + ": another server listens there");
    EXPECT_TRUE(fs::exists(path()));
  }
  // A listener that died without cleaning up.
  const int fd = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path().c_str(), sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  ::close(fd);
  ASSERT_TRUE(fs::exists(path()));
  EXPECT_TRUE(Acceptor::listen(executor(), endpoint()));
}

TEST_F(EndpointFiles, AFileThatIsNoSocketIsLeftAlone) {
  std::ofstream(path()) << "precious";
  EXPECT_EQ(Acceptor::listen(executor(), endpoint()).error().message,
            "can't listen on unix:" + path().string() + ": a file that is no socket is there");
  EXPECT_EQ(fs::file_size(path()), 8u);
}

TEST_F(EndpointFiles, AnothersSocketIsNotRemoved) {
  auto first = std::make_unique<Acceptor>(Acceptor::listen(executor(), endpoint()).value());
  fs::remove(path());
  const auto second = Acceptor::listen(executor(), endpoint()).value();
  first.reset();
  EXPECT_TRUE(fs::exists(path()));
}

TEST_F(EndpointFiles, ATcpPortIsChosenByTheKernelAndThenInUse) {
  const auto acceptor = Acceptor::listen(executor(), parse_endpoint("0").value()).value();
  const Endpoint endpoint = acceptor.endpoint();
  EXPECT_NE(endpoint.port, 0);
  EXPECT_EQ(endpoint.host, "127.0.0.1");
  EXPECT_EQ(refusal(endpoint), "");
  EXPECT_EQ(Acceptor::listen(executor(), endpoint).error().message,
            "can't listen on " + to_string(endpoint) + ": Address already in use");
}

}  // namespace metamer::wire
