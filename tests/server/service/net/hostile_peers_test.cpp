// Peers that are slow, silent, half there, or speak something else: each has a defined end, and the
// others are served.

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "../../../common/wire/certificates.h"
#include "../client.h"
#include "../daemon.h"
#include "server/service/limits.h"

namespace metamer::service::test {

namespace {

std::string hello_frame(const std::string& client = "test") {
  v1::Envelope hello;
  hello.mutable_hello()->set_protocol_version(1);
  hello.mutable_hello()->set_client(client);
  return wire::encode_frame(hello.SerializeAsString());
}

}  // namespace

TEST(HostilePeers, OneThatSendsAByteAtATimeIsServedAndHoldsUpNobody) {
  Daemon daemon;
  Client slow(daemon.port());
  Client other(daemon.socket());
  other.hello();
  for (const char byte : hello_frame()) {
    slow.send_bytes(std::string(1, byte));
    other.ping();
  }
  const auto welcome = slow.receive();
  ASSERT_TRUE(welcome);
  EXPECT_TRUE(welcome->has_welcome());
}

TEST(HostilePeers, BeforeHelloOnlySmallFramesAreRead) {
  Daemon daemon;
  {
    Client large(daemon.port());
    large.send_bytes(hello_frame(std::string(max_frame_before_hello, 'x')).substr(0, 4));
    const auto answer = large.receive();
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->error().code(), v1::Error::FRAME) << "as soon as its length is there";
    EXPECT_TRUE(large.closed_by_server());
  }
  Client small(daemon.port());
  small.send_bytes(hello_frame(std::string(3000, 'x')));
  EXPECT_TRUE(small.receive()->has_welcome());
  small.upload({std::string(3u << 20, 'x')});
}

TEST(HostilePeers, TheSilentAndTheHalfSaidAreClosedInTime) {
  Daemon daemon(
      [](ServiceOptions& options) { options.patience.hello = std::chrono::milliseconds(200); });
  Client silent(daemon.port());
  Client half(daemon.port());
  half.send_bytes(hello_frame().substr(0, 7));
  Client early(daemon.port());
  v1::Envelope ping;
  ping.mutable_ping();
  early.send(ping);  // is told ORDER, and is no more let in for it
  EXPECT_EQ(early.receive()->error().code(), v1::Error::ORDER);
  EXPECT_TRUE(silent.closed_by_server());
  EXPECT_TRUE(half.closed_by_server());
  EXPECT_TRUE(early.closed_by_server());
  Client(daemon.port()).hello();
}

TEST(HostilePeers, AFloodOfSilentOnesKeepsNobodyOut) {
  Daemon daemon;
  std::vector<std::unique_ptr<Client>> flood;
  for (std::size_t i = 0; i < max_newcomers_of_source + 40; ++i)
    flood.push_back(std::make_unique<Client>(daemon.port()));
  // The same source, another source, and those of the flood that are still there.
  Client(daemon.port()).hello();
  Client(daemon.socket()).hello();
  EXPECT_TRUE(flood.front()->closed_by_server());
  EXPECT_EQ(flood.back()->hello().protocol_version(), 1u);
}

TEST(HostilePeers, OneThatReadsNothingIsClosedAndItsWatchGoesOnElsewhere) {
  Daemon daemon(
      [](ServiceOptions& options) { options.patience.stall = std::chrono::milliseconds(300); });
  Client other(daemon.socket());
  other.hello();
  Client deaf(daemon.port());
  deaf.hello();
  const auto job = deaf.submit("picture 2048 2048 256");  // 48 MiB of tiles
  deaf.watch(job);
  for (int tries = 0; tries < 500 && other.info().sessions() > 1; ++tries) ::usleep(20'000);
  EXPECT_EQ(other.info().sessions(), 1u);
  // What came before it was closed can still be read, and then there is an end.
  std::uint64_t last = 0;
  try {
    while (const auto message = deaf.receive()) last = message->job_event().sequence();
  } catch (const std::exception&) {
  }
  Client again(daemon.port());
  again.hello();
  again.watch(job, last + 1);
  again.receive_event_until([](auto& event) { return event.has_finished(); });
}

TEST(HostilePeers, TlsAtAPlainPortIsAFrameErrorAndAnEnd) {
  Daemon daemon;
  Client client(daemon.port());
  client.send_bytes(std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11));
  const auto answer = client.receive();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->error().code(), v1::Error::FRAME);
  EXPECT_EQ(answer->error().message(), "these bytes are TLS, not a frame");
  EXPECT_TRUE(client.closed_by_server());
}

TEST(HostilePeers, PlainWordsAtATlsPortGetAnAlertAndAnEnd) {
  wire::test::Certificates certificates;
  Daemon daemon([&](ServiceOptions& options) {
    options.listen.back() = wire::parse_endpoint("tls:127.0.0.1:0").value();
    options.listening.tls = certificates.sign("server", "IP:127.0.0.1");
  });
  for (const std::string& words : {hello_frame(), std::string("GET / HTTP/1.1\r\n\r\n")}) {
    Client client(daemon.port());
    client.send_bytes(words);
    try {
      client.receive();
      ADD_FAILURE() << "the alert is no frame";
    } catch (const std::exception& error) {
      EXPECT_STREQ(error.what(), wire::describe(wire::FrameError::tls));
    }
    EXPECT_TRUE(client.closed_by_server());
  }
  Client(daemon.socket()).hello();
}

TEST(HostilePeers, OthersFillTheTableAndAKnownUsersFirstSessionComesInAllTheSame) {
  // The arithmetic alone; sharing_test has the sessions.
  const auto enters = [](std::size_t open, std::size_t own, bool listed, bool admin) {
    return may_enter({.open = open, .own = own, .listed = listed, .admin = admin}, 1000, 64);
  };
  EXPECT_TRUE(enters(999, 0, false, false) == false) << "nobody in particular takes the last ones";
  EXPECT_TRUE(enters(990, 0, false, false));
  EXPECT_TRUE(enters(1000, 0, true, false));
  EXPECT_FALSE(enters(1000, 1, true, false));
  EXPECT_TRUE(enters(1000, 3, false, true));
  EXPECT_FALSE(enters(1000, 4, false, true));
  EXPECT_FALSE(enters(1064, 0, true, true));
  EXPECT_TRUE(enters(874, 874, true, false));
  EXPECT_FALSE(enters(875, 875, true, false));
  EXPECT_FALSE(
      may_enter({.open = 3, .own = 2, .listed = true, .admin = false, .max_own = 2}, 1000, 64));
}

}  // namespace metamer::service::test
