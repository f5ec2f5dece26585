// TLS handshakes at a time: few, by source, and none that stands still while others wait.

#include "server/service/net/handshakes.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <openssl/ssl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <map>
#include <memory>
#include <vector>

#include "../../../common/wire/certificates.h"
#include "../daemon.h"
#include "common/wire/frame.h"

namespace metamer::service {

namespace {

using std::chrono::milliseconds;

/// Four places, two of a source; after 100 ms one that stands still may go.
struct FewHandshakes {
  Limits limits = [] {
    Limits few;
    few.handshakes = 4;
    few.source_handshakes = 2;
    return few;
  }();
  Patience patience = [] {
    Patience short_one;
    short_one.handshake = milliseconds(100);
    return short_one;
  }();
  int freed = 0;
  Handshakes handshakes{limits, patience, [this] { ++freed; }};
  Handshakes::Clock::time_point start{};
  std::vector<std::string> closed;
  std::map<std::string, Handshakes::Place> places;

  /// At so many milliseconds. False: it waits.
  bool enter(const std::string& source, const std::string& name, int at) {
    const auto close = [this, name] { closed.push_back(name); };
    const auto place = handshakes.enter(source, close, start + milliseconds(at));
    if (place) places.emplace(name, *place);
    return place.has_value();
  }
  void leave(const std::string& name) {
    handshakes.leave(places.at(name));
    places.erase(name);
  }
};

using Names = std::vector<std::string>;

}  // namespace

TEST(Handshakes, OneBeyondItsSourcesShareWaitsUntilOneOfItsOwnIsDone) {
  FewHandshakes at;
  EXPECT_TRUE(at.enter("a", "a1", 0));
  EXPECT_TRUE(at.enter("a", "a2", 10));
  EXPECT_FALSE(at.enter("a", "a3", 20));
  EXPECT_TRUE(at.enter("b", "b1", 20)) << "another source has room";
  const auto later = at.handshakes.enter(
      "a", [] {}, at.start + milliseconds(20));
  ASSERT_FALSE(later);
  EXPECT_EQ(later.error(), at.start + milliseconds(100)) << "then the oldest may go";
  at.leave("a2");
  EXPECT_EQ(at.freed, 1);
  EXPECT_TRUE(at.enter("a", "a3", 30));
  EXPECT_TRUE(at.closed.empty());
}

TEST(Handshakes, OneThatStandsStillMakesRoomForItsSourceFirst) {
  FewHandshakes at;
  at.enter("b", "b1", 0);
  at.enter("a", "a1", 0);
  at.enter("a", "a2", 50);
  EXPECT_FALSE(at.enter("a", "a3", 99));
  EXPECT_TRUE(at.enter("a", "a3", 100));
  EXPECT_EQ(at.closed, Names{"a1"});
  EXPECT_EQ(at.handshakes.running(), 3u) << "who is closed counts no more";
  at.leave("a1");
  EXPECT_EQ(at.handshakes.running(), 3u);
}

TEST(Handshakes, WhenAllPlacesAreTakenTheGreediestSourceMakesRoom) {
  FewHandshakes at;
  at.enter("a", "a1", 0);
  at.enter("b", "b1", 1);
  at.enter("b", "b2", 2);
  at.enter("c", "c1", 3);
  EXPECT_FALSE(at.enter("d", "d1", 50));
  EXPECT_TRUE(at.enter("d", "d1", 101));
  EXPECT_EQ(at.closed, Names{"b1"});
}

namespace test {

namespace {

int connect_from(const char* address, std::uint16_t port) {
  const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in end{};
  end.sin_family = AF_INET;
  ::inet_pton(AF_INET, address, &end.sin_addr);
  EXPECT_EQ(::bind(fd, reinterpret_cast<const sockaddr*>(&end), sizeof end), 0);
  end.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  end.sin_port = htons(port);
  EXPECT_EQ(::connect(fd, reinterpret_cast<const sockaddr*>(&end), sizeof end), 0);
  // A test that fails does not hang.
  const timeval limit{20, 0};
  ::setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
  return fd;
}

/// A client's side of TLS, with blocking calls.
class TlsClient {
 public:
  TlsClient() : context_(SSL_CTX_new(TLS_client_method())), tls_(SSL_new(context_)) {
    SSL_set_connect_state(tls_);
  }
  ~TlsClient() {
    SSL_free(tls_);
    SSL_CTX_free(context_);
    if (fd_ >= 0) ::close(fd_);
  }
  TlsClient(const TlsClient&) = delete;

  /// The first message of a handshake.
  std::string client_hello() {
    BIO* const sent = BIO_new(BIO_s_mem());
    SSL_set_bio(tls_, BIO_new(BIO_s_mem()), sent);
    SSL_do_handshake(tls_);
    char* bytes = nullptr;
    const long size = BIO_get_mem_data(sent, &bytes);
    return {bytes, static_cast<std::size_t>(size)};
  }
  /// What the server answers to Hello; no body: it has closed.
  v1::Envelope say_hello(const char* address, std::uint16_t port) {
    fd_ = connect_from(address, port);
    SSL_set_fd(tls_, fd_);
    v1::Envelope message;
    message.mutable_hello()->set_protocol_version(1);
    const std::string frame = wire::encode_frame(message.SerializeAsString());
    message.Clear();
    if (SSL_do_handshake(tls_) != 1) return message;
    SSL_write(tls_, frame.data(), static_cast<int>(frame.size()));
    std::string answer(4096, '\0');
    const int got = SSL_read(tls_, answer.data(), static_cast<int>(answer.size()));
    wire::FrameDecoder decoder;
    decoder.feed(std::string_view(answer).substr(0, static_cast<std::size_t>(std::max(got, 0))));
    if (const auto payload = decoder.next(); payload && *payload)
      message.ParseFromString(**payload);
    return message;
  }

 private:
  SSL_CTX* context_;
  SSL* tls_;
  int fd_ = -1;
};

/// A daemon by TLS, and those who begin a handshake there and stop.
class HandshakeFlood : public testing::Test {
 protected:
  wire::test::Certificates certificates_;
  std::vector<int> stalled_;

  std::unique_ptr<Daemon> serve(std::chrono::milliseconds patience) {
    return std::make_unique<Daemon>([&](ServiceOptions& options) {
      options.listen.back() = wire::parse_endpoint("tls:127.0.0.1:0").value();
      options.listening.tls = certificates_.sign("server", "IP:127.0.0.1");
      options.patience.handshake = patience;
    });
  }
  /// All of the first message, or half of it.
  void stall(std::size_t count, std::uint16_t port) {
    const std::string hello = TlsClient().client_hello();
    for (std::size_t i = 0; i < count; ++i) {
      stalled_.push_back(connect_from("127.0.0.1", port));
      const std::size_t size = i % 2 == 0 ? hello.size() : hello.size() / 2;
      (void)!::send(stalled_.back(), hello.data(), size, MSG_NOSIGNAL);
    }
  }
  void TearDown() override {
    for (const int fd : stalled_) ::close(fd);
  }
  /// Through the handshake and Hello, to be told that this takes a token.
  static void expect_served(const v1::Envelope& answer) {
    EXPECT_EQ(answer.error().code(), v1::Error::UNAUTHENTICATED) << answer.ShortDebugString();
  }
};

}  // namespace

TEST_F(HandshakeFlood, OnesThatBeginAndStopKeepNobodyOutOfTheSameAddress) {
  const auto daemon = serve(milliseconds(100));
  stall(200, daemon->port());
  TlsClient good;
  expect_served(good.say_hello("127.0.0.1", daemon->port()));
  Client(daemon->socket()).hello();
}

TEST_F(HandshakeFlood, OnesThatBeginAndStopTakeNothingFromAnotherAddress) {
  const auto daemon = serve(std::chrono::hours(1));
  stall(200, daemon->port());
  TlsClient good;
  expect_served(good.say_hello("127.0.0.2", daemon->port()));
}

TEST_F(HandshakeFlood, ABurstOfOneAddressIsServedInTurns) {
  const auto daemon = serve(milliseconds(1000));
  std::vector<v1::Envelope> answers(3 * max_handshakes_of_source);
  std::vector<std::jthread> clients;
  for (v1::Envelope& answer : answers)
    clients.emplace_back([&] {
      TlsClient client;
      answer = client.say_hello("127.0.0.1", daemon->port());
    });
  clients.clear();
  for (const v1::Envelope& answer : answers) expect_served(answer);
}

}  // namespace test

}  // namespace metamer::service
