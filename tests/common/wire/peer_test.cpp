#include "common/wire/peer.h"

#include <gtest/gtest.h>
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
  EXPECT_EQ(to_string(client), "uid " + std::to_string(::geteuid()));
}

TEST(Peer, OfTcpIsItsAddressWithoutThePort) {
  const auto [client, server] = ends("127.0.0.1:0");
  EXPECT_FALSE(client.user || server.user);
  EXPECT_EQ(to_string(client), "127.0.0.1");
  EXPECT_EQ(client, server);
}

}  // namespace metamer::wire
