// Connecting ends: with a socket, or with a reason, in time.

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <filesystem>
#include <thread>

#include "common/wire/endpoint.h"

namespace metamer::wire {

namespace {

using namespace std::chrono_literals;

class Connect : public testing::Test {
 protected:
  std::string folder_ = (std::filesystem::temp_directory_path() / "connect-XXXXXX").string();
  asio::io_context context_;

  void SetUp() override { ASSERT_NE(::mkdtemp(folder_.data()), nullptr); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path() const { return folder_ + "/socket"; }
  Endpoint unix_endpoint() const { return parse_endpoint("unix:" + path()).value(); }

  /// What comes of it; "connected" where it is a socket.
  std::string outcome(const Endpoint& endpoint, std::chrono::steady_clock::duration limit,
                      asio::cancellation_slot cancel = {}) {
    std::string result;
    asio::co_spawn(
        context_,
        [&]() -> asio::awaitable<void> {
          const auto socket = co_await connect(endpoint, limit);
          result = socket ? "connected" : socket.error().message;
        },
        asio::bind_cancellation_slot(cancel, asio::detached));
    context_.restart();
    context_.run();
    return result;
  }
};

/// A listener that accepts nobody, and whose queue is full.
class FullListener {
 public:
  explicit FullListener(const Endpoint& endpoint) {
    const bool local = endpoint.kind == Endpoint::Kind::unix_socket;
    fd_ = ::socket(local ? AF_UNIX : AF_INET, SOCK_STREAM, 0);
    sockaddr_storage address{};
    socklen_t size = sizeof address;
    if (local) {
      auto& name = reinterpret_cast<sockaddr_un&>(address);
      name.sun_family = AF_UNIX;
      endpoint.path.copy(name.sun_path, sizeof name.sun_path - 1);
      size = sizeof name;
    } else {
      reinterpret_cast<sockaddr_in&>(address) = {AF_INET, 0, {htonl(INADDR_LOOPBACK)}, {}};
      size = sizeof(sockaddr_in);
    }
    EXPECT_EQ(::bind(fd_, reinterpret_cast<sockaddr*>(&address), size), 0);
    EXPECT_EQ(::listen(fd_, 0), 0);
    size = sizeof address;
    EXPECT_EQ(::getsockname(fd_, reinterpret_cast<sockaddr*>(&address), &size), 0);
    endpoint_ = endpoint;
    if (!local) endpoint_.port = ntohs(reinterpret_cast<sockaddr_in&>(address).sin_port);

    // A queue for 0 holds one, and a system may be generous.
    for (int i = 0; i < 4; ++i) {
      const int client = ::socket(address.ss_family, SOCK_STREAM | SOCK_NONBLOCK, 0);
      static_cast<void>(::connect(client, reinterpret_cast<sockaddr*>(&address), size));
      clients_.push_back(client);
    }
  }
  ~FullListener() {
    for (const int client : clients_) ::close(client);
    for (const int accepted : accepted_) ::close(accepted);
    ::close(fd_);
  }
  FullListener(const FullListener&) = delete;

  const Endpoint& endpoint() const { return endpoint_; }
  void accept_one() { accepted_.push_back(::accept(fd_, nullptr, nullptr)); }

 private:
  int fd_ = -1;
  Endpoint endpoint_;
  std::vector<int> clients_, accepted_;
};

}  // namespace

TEST_F(Connect, ARefusalIsToldWithTheSystemsReason) {
  EXPECT_EQ(outcome(unix_endpoint(), 10s),
            "can't connect to unix:" + path() + ": No such file or directory");
  Endpoint closed;
  {
    const auto acceptor =
        Acceptor::listen(context_.get_executor(), parse_endpoint("0").value()).value();
    closed = acceptor.endpoint();
    EXPECT_EQ(outcome(closed, 10s), "connected");
  }
  EXPECT_EQ(outcome(closed, 10s), "can't connect to " + to_string(closed) + ": Connection refused");
}

TEST_F(Connect, ANameIsLookedUp) {
  const auto acceptor =
      Acceptor::listen(context_.get_executor(), parse_endpoint("0").value()).value();
  Endpoint endpoint = acceptor.endpoint();
  endpoint.host = "localhost";
  EXPECT_EQ(outcome(endpoint, 10s), "connected");
  endpoint.host = "no-such-host.invalid";
  EXPECT_TRUE(outcome(endpoint, 10s).starts_with("can't find no-such-host.invalid: "));
}

TEST_F(Connect, WhoNeverAcceptsIsGivenUp) {
  for (const Endpoint& endpoint : {unix_endpoint(), parse_endpoint("0").value()}) {
    const FullListener listener(endpoint);
    EXPECT_EQ(
        outcome(listener.endpoint(), 100ms),
        "can't connect to " + to_string(listener.endpoint()) + ": no connection within 0.1 s");
  }
}

TEST_F(Connect, WhoNeverAcceptsIsGivenUpByABusyLoopToo) {
  // The limit passes before the pause between two tries does, and the loop sees both at once.
  const FullListener listener(unix_endpoint());
  asio::steady_timer timer(context_, 1ms);
  timer.async_wait([](boost::system::error_code) { std::this_thread::sleep_for(200ms); });
  EXPECT_EQ(outcome(listener.endpoint(), 10ms),
            "can't connect to " + to_string(listener.endpoint()) + ": no connection within 0.01 s");
}

TEST_F(Connect, AFullUnixSocketIsTriedUntilThereIsRoom) {
  FullListener listener(unix_endpoint());
  asio::steady_timer timer(context_, 50ms);
  timer.async_wait([&](boost::system::error_code) { listener.accept_one(); });
  EXPECT_EQ(outcome(listener.endpoint(), 10s), "connected");
}

TEST_F(Connect, ACancelledOneEndsAndSaysSo) {
  for (const Endpoint& endpoint : {unix_endpoint(), parse_endpoint("0").value()}) {
    const FullListener listener(endpoint);
    asio::cancellation_signal cancel;
    asio::steady_timer timer(context_, 50ms);
    timer.async_wait(
        [&](boost::system::error_code) { cancel.emit(asio::cancellation_type::terminal); });
    EXPECT_EQ(outcome(listener.endpoint(), 1h, cancel.slot()),
              "can't connect to " + to_string(listener.endpoint()) + ": Operation canceled");
  }
}

}  // namespace metamer::wire
