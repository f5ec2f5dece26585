// Bytes that are no protocol close the session that they came on, and no other.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <random>

#include "common/wire/frame.h"
#include "metamer/v1/envelope.pb.h"
#include "running_job.h"

namespace metamer::test {
namespace {

/// A connection without manners.
class RawClient {
 public:
  explicit RawClient(const Daemon& daemon) : fd_(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, daemon.socket_path().c_str(), sizeof address.sun_path - 1);
    EXPECT_EQ(connect(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  }
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;
  ~RawClient() { close(fd_); }

  /// What the daemon takes; it may close before all of it.
  void send(const std::string& bytes) {
    for (std::size_t sent = 0; sent < bytes.size();) {
      const ssize_t count = ::send(fd_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (count <= 0) return;
      sent += static_cast<std::size_t>(count);
    }
  }
  void send(const v1::Envelope& envelope) {
    send(wire::encode_frame(envelope.SerializeAsString()));
  }
  void stop_sending() { shutdown(fd_, SHUT_WR); }

  /// The next answer; nothing when the daemon closed, or said nothing for 10 s.
  std::optional<v1::Envelope> answer() {
    while (true) {
      auto payload = decoder_.next();
      if (payload && *payload) {
        v1::Envelope envelope;
        EXPECT_TRUE(envelope.ParseFromString(**payload));
        return envelope;
      }
      std::array<char, 4096> bytes{};
      const ssize_t count = receive(bytes);
      if (count <= 0) return std::nullopt;
      decoder_.feed({bytes.data(), static_cast<std::size_t>(count)});
    }
  }
  /// Takes what still comes, up to the end; false: it did not come within 10 s.
  bool is_closed() {
    std::array<char, 4096> bytes{};
    ssize_t count = 1;
    while (count > 0) count = receive(bytes);
    return count != timed_out;
  }

 private:
  static constexpr ssize_t timed_out = -2;
  ssize_t receive(std::array<char, 4096>& bytes) {
    pollfd polled{fd_, POLLIN, 0};
    if (poll(&polled, 1, 10'000) != 1) return timed_out;
    return recv(fd_, bytes.data(), bytes.size(), 0);
  }

  int fd_;
  wire::FrameDecoder decoder_;
};

v1::Envelope hello(std::uint32_t version) {
  v1::Envelope envelope;
  envelope.set_request_id(1);
  envelope.mutable_hello()->set_protocol_version(version);
  return envelope;
}

/// A daemon at work for somebody else, whom none of this may disturb.
class HostileBytes : public testing::Test {
 protected:
  void TearDown() override {
    const RunningJob::End end = job.end();
    EXPECT_EQ(end.code, 0);
    EXPECT_TRUE(end.last.contains("finished")) << end.last;
    EXPECT_EQ(daemon.metamer({"info"}).code, 0);
  }
  Daemon daemon;
  RunningJob job{daemon};
};

TEST_F(HostileBytes, LengthOfFourGigabytes) {
  RawClient client(daemon);
  client.send(std::string("\xff\xff\xff\xff and some bytes"));
  const auto answer = client.answer();
  ASSERT_TRUE(answer && answer->has_error());
  EXPECT_EQ(answer->error().code(), v1::Error::FRAME);
  client.stop_sending();
  EXPECT_TRUE(client.is_closed());
}

TEST_F(HostileBytes, LengthOfFourGigabytesAfterHello) {
  RawClient client(daemon);
  client.send(hello(1));
  const auto welcome = client.answer();
  ASSERT_TRUE(welcome && welcome->has_welcome());
  client.send(std::string("\xff\xff\xff\xff", 4));
  const auto answer = client.answer();
  ASSERT_TRUE(answer && answer->has_error());
  EXPECT_EQ(answer->error().code(), v1::Error::FRAME);
  client.stop_sending();
  EXPECT_TRUE(client.is_closed());
}

TEST_F(HostileBytes, TruncatedFrame) {
  RawClient client(daemon);
  client.send(hello(1));
  ASSERT_TRUE(client.answer());
  const std::string frame = wire::encode_frame(hello(1).SerializeAsString());
  client.send(frame.substr(0, frame.size() - 1));
  client.stop_sending();
  EXPECT_TRUE(client.is_closed());
}

TEST_F(HostileBytes, RandomBytes) {
  std::mt19937 random(20240229);
  std::uniform_int_distribution<int> byte(0, 255);
  for (int i = 0; i < 50; ++i) {
    RawClient client(daemon);
    std::string bytes(1000, ' ');
    for (char& c : bytes) c = static_cast<char>(byte(random));
    client.send(bytes);
    client.stop_sending();
    EXPECT_TRUE(client.is_closed()) << i;
  }
}

TEST_F(HostileBytes, RandomBytesInAFrame) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> byte(0, 255);
  for (int i = 0; i < 50; ++i) {
    RawClient client(daemon);
    client.send(hello(1));
    ASSERT_TRUE(client.answer());
    std::string bytes(200, ' ');
    for (char& c : bytes) c = static_cast<char>(byte(random));
    client.send(wire::encode_frame(bytes));
    client.stop_sending();
    EXPECT_TRUE(client.is_closed()) << i;
  }
}

TEST_F(HostileBytes, AnotherVersionIsToldAndClosed) {
  RawClient client(daemon);
  client.send(hello(999));
  const auto answer = client.answer();
  ASSERT_TRUE(answer && answer->has_error());
  EXPECT_EQ(answer->error().code(), v1::Error::VERSION);
  EXPECT_EQ(answer->error().message(),
            "this server speaks version 1 of the protocol, the client 999");
  client.stop_sending();
  EXPECT_TRUE(client.is_closed());
}

TEST_F(HostileBytes, NothingBeforeHello) {
  RawClient client(daemon);
  v1::Envelope early;
  early.set_request_id(5);
  early.mutable_list_jobs();
  client.send(early);
  const auto answer = client.answer();
  ASSERT_TRUE(answer && answer->has_error());
  EXPECT_EQ(answer->request_id(), 5u);
  EXPECT_EQ(answer->error().code(), v1::Error::ORDER);
}

TEST_F(HostileBytes, AMessageThatNobodyKnowsIsRefusedAndTheSessionGoesOn) {
  RawClient client(daemon);
  client.send(hello(1));
  ASSERT_TRUE(client.answer());
  // Envelope: request_id 6, field 99 a sub-message of no bytes.
  client.send(wire::encode_frame(std::string("\x08\x06\x9a\x06\x00", 5)));
  const auto refused = client.answer();
  ASSERT_TRUE(refused && refused->has_error());
  EXPECT_EQ(refused->request_id(), 6u);
  EXPECT_EQ(refused->error().code(), v1::Error::UNKNOWN_MESSAGE);
  v1::Envelope ping;
  ping.set_request_id(7);
  ping.mutable_ping();
  client.send(ping);
  const auto pong = client.answer();
  EXPECT_TRUE(pong && pong->has_pong());
}

}  // namespace
}  // namespace metamer::test
