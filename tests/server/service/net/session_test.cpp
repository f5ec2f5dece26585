// What one client can do, and what it can't do to others.

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "../daemon.h"
#include "common/digest.h"
#include "server/service/limits.h"

namespace metamer::service::test {

namespace {

v1::Envelope hello(std::uint32_t version) {
  v1::Envelope message;
  message.mutable_hello()->set_protocol_version(version);
  return message;
}

v1::Envelope ping() {
  v1::Envelope message;
  message.mutable_ping();
  return message;
}

void expect_error(const v1::Envelope& answer, v1::Error::Code code, const std::string& message) {
  ASSERT_TRUE(answer.has_error()) << answer.ShortDebugString();
  EXPECT_EQ(answer.error().code(), code);
  EXPECT_EQ(answer.error().message(), message);
}

class SessionTest : public testing::Test {
 protected:
  Daemon daemon_;
  Client client_{daemon_.socket()};

  /// An error without a request, then the end.
  void expect_frame_error(Client& client, const std::string& message) {
    const auto answer = client.receive();
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->request_id(), 0u);
    expect_error(*answer, v1::Error::FRAME, message);
    EXPECT_TRUE(client.closed_by_server());
  }
};

}  // namespace

TEST_F(SessionTest, WelcomeSaysWhatTheServerAcceptsAndCanDo) {
  const v1::Welcome welcome = client_.hello();
  EXPECT_EQ(welcome.protocol_version(), 1u);
  EXPECT_EQ(welcome.server(), "metamerd " METAMER_VERSION);
  EXPECT_EQ(welcome.limits().control_frame(), 256u << 10);
  EXPECT_EQ(welcome.limits().chunk(), 4u << 20);
  EXPECT_EQ(welcome.limits().asset(), 1u << 30);
  EXPECT_EQ(welcome.limits().assets_per_job(), 1024u);
  EXPECT_EQ(welcome.limits().queued_jobs(), 256u);
  EXPECT_EQ(welcome.limits().pixels(), 256u << 20);
  EXPECT_EQ(welcome.capabilities().backend(0), "fake");
}

TEST_F(SessionTest, OlderAndNewerVersionsAreRefusedAndTheConnectionClosed) {
  for (const std::uint32_t version : {0u, 2u, ~0u}) {
    Client client(daemon_.socket());
    expect_error(
        client.ask(hello(version)), v1::Error::VERSION,
        "this server speaks version 1 of the protocol, the client " + std::to_string(version));
    EXPECT_TRUE(client.closed_by_server());
  }
}

TEST_F(SessionTest, HelloComesFirstAndOnce) {
  expect_error(client_.ask(ping()), v1::Error::ORDER, "the first message has to be Hello");
  client_.hello();
  expect_error(client_.ask(hello(1)), v1::Error::ORDER, "Hello was said before");
  client_.ping();
}

TEST_F(SessionTest, NothingIsStartedForWhoHasNotSaidHello) {
  v1::Envelope info;
  info.mutable_get_info();
  expect_error(client_.ask(info), v1::Error::ORDER, "the first message has to be Hello");
  EXPECT_FALSE(std::filesystem::exists(daemon_.folder() / "started-gl"));
  client_.hello();
  EXPECT_TRUE(client_.ask(info).has_info());
  EXPECT_TRUE(std::filesystem::exists(daemon_.folder() / "started-gl"));
}

TEST_F(SessionTest, UnknownMessagesGetAnErrorAndTheSessionGoesOn) {
  client_.hello();
  expect_error(client_.ask({}), v1::Error::UNKNOWN_MESSAGE,
               "this server does not know that message");
  v1::Envelope from_the_future;
  from_the_future.GetReflection()
      ->MutableUnknownFields(&from_the_future)
      ->AddLengthDelimited(1000, "news");
  expect_error(client_.ask(from_the_future), v1::Error::UNKNOWN_MESSAGE,
               "this server does not know that message");
  v1::Envelope welcome;
  welcome.mutable_welcome();
  expect_error(client_.ask(welcome), v1::Error::UNKNOWN_MESSAGE,
               "that message is the server's to send");
  client_.ping();
}

TEST_F(SessionTest, AFrameOf4GiBEndsThatSessionAlone) {
  Client other(daemon_.socket());
  other.hello();
  client_.hello();
  client_.send_bytes(std::string("\xFF\xFF\xFF\xFF", 4));
  expect_frame_error(client_, "the frame's length is over the limit");
  other.ping();
}

TEST_F(SessionTest, AFrameOfNothingIsAFrameError) {
  client_.hello();
  client_.send_bytes(std::string(4, '\0'));
  expect_frame_error(client_, "the frame's length is 0");
}

TEST_F(SessionTest, ALargeFrameThatIsNoChunkIsAFrameError) {
  client_.hello();
  v1::Envelope message;
  message.mutable_hello()->set_client(std::string(300'000, 'x'));
  client_.send(message);
  expect_frame_error(client_, "a control message of " + std::to_string(message.ByteSizeLong()) +
                                  " bytes is over the limit of 262144");
}

TEST_F(SessionTest, ATruncatedFrameEndsThatSessionAlone) {
  Client other(daemon_.socket());
  other.hello();
  client_.hello();
  client_.send_bytes(std::string("\0\0\1\0half", 8));
  client_.finish_sending();
  EXPECT_TRUE(client_.closed_by_server());
  other.ping();
}

TEST_F(SessionTest, RandomBytesEndThatSessionAlone) {
  Client other(daemon_.socket());
  other.hello();
  std::mt19937 random(1);  // fixed: a failure can be repeated
  for (int round = 0; round < 200; ++round) {
    Client client(daemon_.socket());
    if (round % 2 == 0) client.hello();
    std::string bytes;
    for (int i = 0; i < 600; ++i) bytes.push_back(static_cast<char>(random()));
    // Every other time a sound length, so that the parser sees the bytes too.
    client.send_bytes(round % 4 < 2 ? bytes : wire::encode_frame(bytes));
    client.finish_sending();
    try {
      while (client.receive()) {
      }
    } catch (const std::runtime_error& error) {
      FAIL() << error.what();
    }
    other.ping();
  }
}

TEST_F(SessionTest, AssetsAreOfferedSentAndThenKnown) {
  client_.hello();
  const std::string asset(10'000'000, 'a');
  v1::Envelope offer;
  offer.mutable_offer_assets()->add_sha256(std::string(to_bytes(sha256(asset))));
  ASSERT_EQ(client_.ask(offer).missing_assets().sha256_size(), 1);
  for (std::size_t at = 0; at < asset.size(); at += 4u << 20) {
    v1::Envelope message;
    message.set_request_id(1000 + at);
    v1::AssetChunk& chunk = *message.mutable_asset_chunk();
    chunk.set_sha256(std::string(to_bytes(sha256(asset))));
    chunk.set_size(asset.size());
    chunk.set_offset(at);
    chunk.set_data(asset.substr(at, 4u << 20));
    client_.send(message);
  }
  const auto stored = client_.receive();
  ASSERT_TRUE(stored && stored->has_asset_stored());
  EXPECT_EQ(stored->request_id(), 1000 + (8u << 20));
  EXPECT_EQ(client_.ask(offer).missing_assets().sha256_size(), 0);
}

TEST_F(SessionTest, ChunksThatAreWrongGetTheirErrors) {
  client_.hello();
  const auto chunk = [&](const std::string& digest, std::uint64_t size, std::uint64_t offset,
                         const std::string& data) {
    v1::Envelope message;
    message.mutable_asset_chunk()->set_sha256(digest);
    message.mutable_asset_chunk()->set_size(size);
    message.mutable_asset_chunk()->set_offset(offset);
    message.mutable_asset_chunk()->set_data(data);
    return message;
  };
  const std::string digest(to_bytes(sha256("right")));
  const std::string other(to_bytes(sha256("other")));
  expect_error(client_.ask(chunk("short", 5, 0, "right")), v1::Error::LIMIT,
               "a digest has 32 bytes, not 5");
  expect_error(client_.ask(chunk(digest, 5, 2, "ght")), v1::Error::ORDER,
               "an asset's first chunk has to be at offset 0, not 2");
  client_.send(chunk(digest, 5, 0, "ri"));
  expect_error(client_.ask(chunk(other, 5, 0, "other")), v1::Error::ORDER,
               "a chunk of another asset came before this one was complete");
  expect_error(client_.ask(chunk(digest, 5, 0, "wrong")), v1::Error::DIGEST,
               "the asset offered as " + to_hex(sha256("right")) + " has the digest " +
                   to_hex(sha256("wrong")));
  EXPECT_TRUE(client_.ask(chunk(digest, 5, 0, "right")).has_asset_stored());
}

TEST_F(SessionTest, SubmitSaysWhatIsMissingOrTooMuch) {
  client_.hello();
  const std::string digest(to_bytes(sha256("nobody sent this")));
  v1::Envelope message;
  message.mutable_submit()->set_scene_sha256(digest);
  expect_error(client_.ask(message), v1::Error::MISSING_ASSET,
               "the store lacks the scene (" + to_hex(sha256("nobody sent this")) + ")");
  message.mutable_submit()->set_scene_sha256(client_.upload({"picture 8 8 8"})[0]);
  v1::AssetName& asset = *message.mutable_submit()->add_asset();
  asset.set_name("spectra/tcs.sp");
  asset.set_sha256(digest);
  expect_error(client_.ask(message), v1::Error::MISSING_ASSET,
               "the store lacks spectra/tcs.sp (" + to_hex(sha256("nobody sent this")) + ")");
  message.mutable_submit()->set_name(std::string(201, 'x'));
  expect_error(client_.ask(message), v1::Error::LIMIT,
               "a job's name of 201 bytes is over the limit of 200");
  message.mutable_submit()->set_name("");
  for (int i = 0; i < 1024; ++i) message.mutable_submit()->add_asset();
  expect_error(client_.ask(message), v1::Error::LIMIT,
               "a scene with 1025 assets is over the limit of 1024");
}

TEST_F(SessionTest, JobsThatAreNotThereGetNotFound) {
  client_.hello();
  v1::Envelope watch, cancel, pause, resume;
  watch.mutable_watch()->set_job_id(9);
  cancel.mutable_cancel()->set_job_id(9);
  pause.mutable_pause()->set_job_id(9);
  resume.mutable_resume()->set_job_id(9);
  for (const auto& message : {watch, cancel, pause, resume}) {
    expect_error(client_.ask(message), v1::Error::NOT_FOUND, "there is no job 9");
  }
}

TEST_F(SessionTest, RequestsSentInOneGoAreAnsweredInOrder) {
  client_.hello();
  std::string bytes;
  for (std::uint64_t i = 1; i <= 1000; ++i) {
    v1::Envelope message = ping();
    message.set_request_id(i);
    bytes += wire::encode_frame(message.SerializeAsString());
  }
  client_.send_bytes(bytes);
  for (std::uint64_t i = 1; i <= 1000; ++i) {
    const auto answer = client_.receive();
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->request_id(), i);
  }
}

}  // namespace metamer::service::test
