#include "common/wire/channel.h"

#include <google/protobuf/unknown_field_set.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "metamer/v1/envelope.pb.h"

namespace metamer::wire {

namespace {

v1::Envelope chunk(std::size_t size) {
  v1::Envelope message;
  message.set_request_id(1);
  message.mutable_asset_chunk()->set_sha256(std::string(32, 'd'));
  message.mutable_asset_chunk()->set_size(size);
  message.mutable_asset_chunk()->set_data(std::string(size, 'x'));
  return message;
}

v1::Envelope event() {
  v1::Envelope message;
  message.set_request_id(1);
  message.mutable_job_event()->set_job_id(1);
  message.mutable_job_event()->set_sequence(2);
  message.mutable_job_event()->set_time(3);
  return message;
}

/// What a peer that has sent these bytes and closed makes a channel say.
struct Reading {
  std::vector<v1::Envelope> messages;
  ChannelError error;
};

Reading read_all(const std::string& bytes, Peer peer) {
  asio::io_context context;
  int pair[2];
  EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, pair), 0);
  Socket socket(context, asio::generic::stream_protocol(AF_UNIX, 0), pair[1]);
  Channel channel(std::move(socket), peer);
  Reading reading;
  asio::co_spawn(
      context,
      [&]() -> asio::awaitable<void> {
        while (true) {
          v1::Envelope message;
          const auto got = co_await channel.read(message);
          if (!got) {
            reading.error = got.error();
            co_return;
          }
          reading.messages.push_back(message);
        }
      },
      asio::detached);
  asio::local::stream_protocol::socket writer(context, asio::local::stream_protocol(), pair[0]);
  asio::async_write(writer, asio::buffer(bytes),
                    [&](boost::system::error_code, std::size_t) { writer.close(); });
  context.run();
  return reading;
}

std::string frame(const v1::Envelope& message) { return encode_frame(message.SerializeAsString()); }

}  // namespace

TEST(Channel, MessagesArriveInOrderAndTheEndIsKnown) {
  v1::Envelope ping;
  ping.set_request_id(1);
  ping.mutable_ping();
  const auto reading = read_all(frame(ping) + frame(chunk(4 << 20)) + frame(ping), Peer::client);
  ASSERT_EQ(reading.messages.size(), 3u);
  EXPECT_EQ(reading.messages[1].asset_chunk().data().size(), 4u << 20);
  EXPECT_EQ(reading.error.kind, ChannelError::Kind::closed);
}

TEST(Channel, AnEndInMidFrameIsTruncation) {
  const std::string bytes = frame(chunk(100));
  for (const std::size_t size : {std::size_t{1}, std::size_t{4}, bytes.size() - 1}) {
    EXPECT_EQ(read_all(bytes.substr(0, size), Peer::client).error.kind,
              ChannelError::Kind::truncated);
  }
}

TEST(Channel, OnlyAChunkMayBeLargeFromAClient) {
  EXPECT_TRUE(is_bulk(Peer::client, chunk(300'000).SerializeAsString()));
  v1::Envelope hello;
  hello.mutable_hello()->set_client(std::string(300'000, 'x'));
  EXPECT_FALSE(is_bulk(Peer::client, hello.SerializeAsString()));
  EXPECT_EQ(read_all(frame(hello), Peer::client).error.kind, ChannelError::Kind::frame);
  v1::Envelope tile = event();
  tile.mutable_job_event()->mutable_tile()->set_xyz(std::string(300'000, 'x'));
  EXPECT_FALSE(is_bulk(Peer::client, tile.SerializeAsString()));
}

TEST(Channel, OnlyATileOrAPreviewMayBeLargeFromAServer) {
  v1::Envelope tile = event();
  tile.mutable_job_event()->mutable_tile()->set_width(256);
  tile.mutable_job_event()->mutable_tile()->set_xyz(std::string(256 * 256 * 12, 'x'));
  EXPECT_TRUE(is_bulk(Peer::server, tile.SerializeAsString()));
  EXPECT_EQ(read_all(frame(tile), Peer::server).messages.size(), 1u);
  v1::Envelope preview = event();
  preview.mutable_job_event()->mutable_preview()->set_rgb(std::string(300'000, 'x'));
  EXPECT_TRUE(is_bulk(Peer::server, preview.SerializeAsString()));
  v1::Envelope failed = event();
  failed.mutable_job_event()->mutable_failed()->set_reason(std::string(300'000, 'x'));
  EXPECT_FALSE(is_bulk(Peer::server, failed.SerializeAsString()));
  EXPECT_FALSE(is_bulk(Peer::server, chunk(300'000).SerializeAsString()));
}

TEST(Channel, AServersPlanMayHaveLargeFactorsAndIsSmallItself) {
  v1::Envelope factors = event();
  factors.mutable_job_event()->mutable_planned()->mutable_plan()->set_width(64);
  factors.mutable_job_event()->mutable_planned()->set_factors(std::string(300'000, 'x'));
  EXPECT_TRUE(is_bulk(Peer::server, factors.SerializeAsString()));
  v1::Envelope plan = event();
  plan.mutable_job_event()->mutable_planned()->mutable_plan()->add_need(std::string(300'000, 'x'));
  EXPECT_FALSE(is_bulk(Peer::server, plan.SerializeAsString()));
}

TEST(Channel, NothingIsLargeFromAWorker) {
  EXPECT_FALSE(is_bulk(Peer::worker, chunk(300'000).SerializeAsString()));
}

TEST(Channel, AChunkThatHidesManyFieldsIsNotBulk) {
  // Two bytes each, which a parser would make thirty or more of.
  v1::Envelope message = chunk(100);
  auto* hidden =
      message.asset_chunk().GetReflection()->MutableUnknownFields(message.mutable_asset_chunk());
  for (int i = 0; i < 200'000; ++i) hidden->AddVarint(9, 1);
  EXPECT_GT(message.ByteSizeLong(), max_control_frame);
  EXPECT_FALSE(is_bulk(Peer::client, message.SerializeAsString()));

  v1::Envelope grouped = chunk(300'000);
  grouped.asset_chunk()
      .GetReflection()
      ->MutableUnknownFields(grouped.mutable_asset_chunk())
      ->AddGroup(9);
  EXPECT_FALSE(is_bulk(Peer::client, grouped.SerializeAsString()));

  v1::Envelope accompanied = chunk(300'000);
  accompanied.GetReflection()->MutableUnknownFields(&accompanied)->AddLengthDelimited(9, "x");
  EXPECT_FALSE(is_bulk(Peer::client, accompanied.SerializeAsString()));
}

TEST(Channel, BytesThatAreNoMessageAreAFrameError) {
  const auto reading = read_all(encode_frame("\xFF\xFF\xFF"), Peer::client);
  EXPECT_EQ(reading.error.kind, ChannelError::Kind::frame);
  EXPECT_EQ(reading.error.message, "the frame holds no metamer.v1.Envelope");
}

}  // namespace metamer::wire
