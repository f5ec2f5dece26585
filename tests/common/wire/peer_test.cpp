#include "common/wire/peer.h"

#include <gtest/gtest.h>
#include <netinet/tcp.h>
#include <unistd.h>

#include <filesystem>

namespace metamer::wire {

namespace {

/// What each end of a connection to `listen` says of the other.
std::pair<PeerIdentity, PeerIdentity> ends(const std::string& listen) {
  asio::io_context loop;
  auto acceptor = Acceptor::listen(loop.get_executor(), parse_endpoint(listen).value()).value();
  std::pair<PeerIdentity, PeerIdentity> result;
  asio::co_spawn(
      loop,
      [&]() -> asio::awaitable<void> {
        auto [error, socket] = co_await acceptor.accept();
        result.first = peer_of(socket);
      },
      asio::detached);
  asio::co_spawn(
      loop,
      [&]() -> asio::awaitable<void> {
        auto socket = co_await connect(acceptor.endpoint());
        if (socket) result.second = peer_of(*socket);
      },
      asio::detached);
  loop.run();
  return result;
}

}  // namespace

TEST(Peer, OfAUnixSocketIsItsUser) {
  const std::string path = "/tmp/metamer-peer-" + std::to_string(::getpid());
  const auto [client, server] = ends("unix:" + path);
  EXPECT_EQ(client.user, ::geteuid());
  EXPECT_EQ(server.user, ::geteuid());
  EXPECT_EQ(client.process, ::getpid());
  EXPECT_TRUE(client.local && server.local);
  EXPECT_EQ(to_string(client), "uid " + std::to_string(::geteuid()));
}

TEST(Peer, OfTcpIsItsAddressWithoutThePort) {
  const auto [client, server] = ends("127.0.0.1:0");
  EXPECT_FALSE(client.user || server.user);
  EXPECT_EQ(to_string(client), "127.0.0.1");
  EXPECT_EQ(client, server);
  EXPECT_TRUE(client.local);
}

// Half-open peers: nobody tells us that they are gone, so the system has to ask (tcp(7)).
TEST(Peer, OfTcpIsAskedWhetherItIsStillThere) {
  asio::io_context loop;
  auto acceptor = Acceptor::listen(loop.get_executor(), parse_endpoint("0").value()).value();
  const auto check = [](Socket& socket) {
    const auto option = [&](int level, int name) {
      int value = -1;
      socklen_t size = sizeof value;
      ::getsockopt(socket.native_handle(), level, name, &value, &size);
      return value;
    };
    EXPECT_EQ(option(SOL_SOCKET, SO_KEEPALIVE), 1);
    EXPECT_EQ(option(IPPROTO_TCP, TCP_KEEPIDLE), 30);
    EXPECT_EQ(option(IPPROTO_TCP, TCP_USER_TIMEOUT), 30'000);
    EXPECT_EQ(option(IPPROTO_TCP, TCP_NODELAY), 1);
  };
  int checked = 0;
  const auto serve = [&]() -> asio::awaitable<void> {
    auto [error, socket] = co_await acceptor.accept();
    check(socket);
    ++checked;
  };
  const auto ask = [&]() -> asio::awaitable<void> {
    auto socket = co_await connect(acceptor.endpoint());
    if (!socket) co_return;
    check(*socket);
    ++checked;
  };
  asio::co_spawn(loop, serve(), asio::detached);
  asio::co_spawn(loop, ask(), asio::detached);
  loop.run();
  EXPECT_EQ(checked, 2);
}

}  // namespace metamer::wire
