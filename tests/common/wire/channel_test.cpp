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

TEST(Channel, TlsIsKnownByItsFirstBytes) {
  for (const std::string& bytes :
       {std::string("\x16\x03\x01\x02", 4), std::string("\x15\x03\x03\x00\x02\x02\x46", 7)}) {
    const auto reading = read_all(bytes, Peer::client);
    EXPECT_EQ(reading.error.kind, ChannelError::Kind::frame);
    EXPECT_TRUE(reading.error.tls);
  }
}

namespace {

/// Two ends of a connection.
struct Ends {
  asio::io_context loop;
  Socket one{loop}, other{loop};
  Ends() {
    int pair[2];
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, pair), 0);
    one.assign(asio::generic::stream_protocol(AF_UNIX, 0), pair[0]);
    other.assign(asio::generic::stream_protocol(AF_UNIX, 0), pair[1]);
  }
};

}  // namespace

TEST(Channel, TakesNoFrameAboveItsLimitUntilThatIsLifted) {
  for (const bool lifted : {false, true}) {
    Ends ends;
    Channel channel(std::move(ends.one), Peer::client);
    channel.limit_frames(4096);
    if (lifted) channel.lift_frame_limit();
    const std::string bytes = frame(chunk(5000));
    asio::write(ends.other, asio::buffer(bytes));
    tl::expected<void, ChannelError> got;
    v1::Envelope message;
    asio::co_spawn(
        ends.loop, [&]() -> asio::awaitable<void> { got = co_await channel.read(message); },
        asio::detached);
    ends.loop.run();
    EXPECT_EQ(got.has_value(), lifted);
  }
}

TEST(Channel, APeerThatTakesNothingIsGivenUpAndOneThatTakesLittleIsNot) {
  using namespace std::chrono_literals;
  for (const bool reads : {false, true}) {
    Ends ends;
    Channel channel(std::move(ends.one), Peer::client);
    channel.limit_stall(500ms);
    tl::expected<void, ChannelError> sent;
    const std::string frames(4 << 20, 'x');
    asio::co_spawn(
        ends.loop,
        [&]() -> asio::awaitable<void> {
          sent = co_await channel.write_frames(frames);
          channel.close();
        },
        asio::detached);
    // 300 pieces of 16 KiB, each well within the limit, all of them well beyond it.
    asio::co_spawn(
        ends.loop,
        [&]() -> asio::awaitable<void> {
          asio::steady_timer pause(ends.loop);
          std::array<char, 16 << 10> piece;
          while (reads) {
            const auto [error, size] = co_await ends.other.async_read_some(
                asio::buffer(piece), asio::as_tuple(asio::use_awaitable));
            if (error) co_return;
            pause.expires_after(4ms);
            co_await pause.async_wait(asio::use_awaitable);
          }
        },
        asio::detached);
    ends.loop.run();
    EXPECT_EQ(sent.has_value(), reads);
    if (sent) continue;
    EXPECT_EQ(sent.error().kind, ChannelError::Kind::stalled);
  }
}

TEST(Channel, APeerThatNeverPausesLeavesOthersTheirTurns) {
  Ends ends;
  Channel channel(std::move(ends.one), Peer::client);
  v1::Envelope ping;
  ping.mutable_ping();
  std::string bytes;
  for (int i = 0; i < 100'000; ++i) bytes += frame(ping);
  int read = 0, read_at_turn = -1;
  asio::async_write(ends.other, asio::buffer(bytes),
                    [&](boost::system::error_code, std::size_t) { ends.other.close(); });
  asio::co_spawn(
      ends.loop,
      [&]() -> asio::awaitable<void> {
        v1::Envelope message;
        while (co_await channel.read(message)) {
          if (++read == 1) asio::post(ends.loop, [&] { read_at_turn = read; });
        }
      },
      asio::detached);
  ends.loop.run();
  EXPECT_EQ(read, 100'000);
  EXPECT_GT(read_at_turn, 0);
  EXPECT_LE(read_at_turn, (64 << 10) / 6);
}

}  // namespace metamer::wire
