#include "common/wire/channel.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/wire_format_lite.h>

#include <array>
#include <optional>
#include <vector>

#include "metamer/v1/envelope.pb.h"

namespace metamer::wire {

namespace {

using boost::system::error_code;
using google::protobuf::internal::WireFormatLite;
using google::protobuf::io::CodedInputStream;
using Kind = ChannelError::Kind;

struct Field {
  int number = 0;
  std::string_view bytes;  // of a length-delimited field
};

/// A bulk message and its wrappers have fewer fields than this.
constexpr std::size_t max_bulk_fields = 8;

/// The fields of a serialised message, groups excluded; nothing when it has more than
/// max_bulk_fields or is malformed. Allocates nothing for what the fields hold.
std::optional<std::vector<Field>> few_fields(std::string_view message) {
  CodedInputStream input(reinterpret_cast<const std::uint8_t*>(message.data()),
                         static_cast<int>(message.size()));
  std::vector<Field> fields;
  while (const std::uint32_t tag = input.ReadTag()) {
    if (fields.size() == max_bulk_fields) return std::nullopt;
    Field field{.number = WireFormatLite::GetTagFieldNumber(tag), .bytes = {}};
    if (WireFormatLite::GetTagWireType(tag) == WireFormatLite::WIRETYPE_LENGTH_DELIMITED) {
      std::uint32_t length = 0;
      if (!input.ReadVarint32(&length)) return std::nullopt;
      const auto begin = static_cast<std::size_t>(input.CurrentPosition());
      if (length > message.size() - begin) return std::nullopt;
      field.bytes = message.substr(begin, length);
      if (!input.Skip(static_cast<int>(length))) return std::nullopt;
    } else if (WireFormatLite::GetTagWireType(tag) == WireFormatLite::WIRETYPE_START_GROUP ||
               !WireFormatLite::SkipField(&input, tag)) {
      return std::nullopt;
    }
    fields.push_back(field);
  }
  if (static_cast<std::size_t>(input.CurrentPosition()) != message.size()) return std::nullopt;
  return fields;
}

/// The bytes of the one field in `message` that is `number`; nothing when there is none, when
/// another length-delimited field is there too, or when there are too many fields.
std::optional<std::string_view> only_submessage(std::string_view message,
                                                std::initializer_list<int> numbers) {
  const auto fields = few_fields(message);
  if (!fields) return std::nullopt;
  std::optional<std::string_view> found;
  for (const Field& field : *fields) {
    if (field.bytes.empty()) continue;
    bool wanted = false;
    for (const int number : numbers) wanted = wanted || field.number == number;
    if (!wanted || found) return std::nullopt;
    found = field.bytes;
  }
  return found;
}

/// Its factors are plain bytes; its plan, a message, has to be small.
bool is_bulk_planned(std::string_view planned) {
  const auto fields = few_fields(planned);
  if (!fields) return false;
  for (const Field& field : *fields)
    if (field.number != v1::Planned::kFactorsFieldNumber && field.bytes.size() > max_control_frame)
      return false;
  return true;
}

std::size_t frame_limit(Peer peer) { return peer == Peer::worker ? max_worker_frame : max_frame; }

tl::unexpected<ChannelError> failed(Kind kind, std::string message) {
  return tl::unexpected(ChannelError{kind, std::move(message)});
}

}  // namespace

bool is_bulk(Peer peer, std::string_view payload) {
  switch (peer) {
    case Peer::client: {
      const auto chunk = only_submessage(payload, {v1::Envelope::kAssetChunkFieldNumber});
      return chunk && few_fields(*chunk);
    }
    case Peer::server: {
      const auto event = only_submessage(payload, {v1::Envelope::kJobEventFieldNumber});
      if (!event) return false;
      if (const auto planned = only_submessage(*event, {v1::JobEvent::kPlannedFieldNumber}))
        return is_bulk_planned(*planned);
      const auto picture = only_submessage(
          *event, {v1::JobEvent::kTileFieldNumber, v1::JobEvent::kPreviewFieldNumber});
      return picture && few_fields(*picture);
    }
    case Peer::worker:
      return false;
  }
  return false;
}

Channel::Channel(std::unique_ptr<Stream> stream, Peer peer)
    : stream_(std::move(stream)),
      peer_(peer),
      decoder_(frame_limit(peer)),
      stall_(stream_->executor()) {}

void Channel::lift_frame_limit() { decoder_.set_limit(frame_limit(peer_)); }

/// Takes what has come, at most a few tiles' rows at a time. All channels of a thread share the
/// memory for it, as nothing waits while it is in use: a silent channel has none.
error_code Channel::take() {
  thread_local std::array<char, 64 << 10> piece;
  const auto [error, size] = stream_->read(piece.data(), piece.size());
  if (!error) decoder_.feed({piece.data(), size});
  return error;
}

/// Lets others have their turn: a peer that sends, or reads, without a pause does not hold them up.
asio::awaitable<void> Channel::give_way() {
  co_await asio::post(stream_->executor(), asio::use_awaitable);
}

/// Takes what has come, or else waits until something has.
asio::awaitable<error_code> Channel::receive() {
  const error_code error = take();
  if (error == asio::error::would_block) co_return co_await stream_->wait_to_read();
  if (!error) co_await give_way();
  co_return error;
}

asio::awaitable<tl::expected<void, ChannelError>> Channel::read(
    google::protobuf::MessageLite& message) {
  while (true) {
    auto payload = decoder_.next();
    if (!payload) {
      co_return tl::unexpected(
          ChannelError{Kind::frame, describe(payload.error()), payload.error() == FrameError::tls});
    }
    if (*payload) {
      const std::string& bytes = **payload;
      if (bytes.size() > max_control_frame && !is_bulk(peer_, bytes)) {
        co_return failed(Kind::frame, "a control message of " + std::to_string(bytes.size()) +
                                          " bytes is over the limit of " +
                                          std::to_string(max_control_frame));
      }
      if (!message.ParseFromString(bytes)) {
        co_return failed(Kind::frame, "the frame holds no " + message.GetTypeName());
      }
      co_return tl::expected<void, ChannelError>();
    }

    const error_code error = co_await receive();
    if (error == asio::error::eof) {
      if (!decoder_.in_frame()) co_return failed(Kind::closed, "the peer closed the connection");
      co_return failed(Kind::truncated, "the peer closed the connection in mid-frame");
    }
    if (error) co_return failed(Kind::system, error.message());
  }
}

asio::awaitable<tl::expected<void, ChannelError>> Channel::write(
    const google::protobuf::MessageLite& message) {
  co_return co_await write_frames(encode_frame(message.SerializeAsString()));
}

/// Waits for room; closes the stream when there is none in time.
asio::awaitable<error_code> Channel::wait_to_write() {
  if (!stall_limit_) co_return co_await stream_->wait_to_write();
  stall_.expires_after(*stall_limit_);
  const auto stalled = std::make_shared<bool>(false);
  stall_.async_wait([stream = std::weak_ptr(stream_), stalled](error_code cancelled) {
    const auto open = stream.lock();
    if (cancelled || !open) return;
    *stalled = true;
    open->close();
  });
  const error_code error = co_await stream_->wait_to_write();
  stall_.cancel();
  stalled_ = *stalled;
  co_return error;
}

asio::awaitable<tl::expected<void, ChannelError>> Channel::write_frames(std::string frames) {
  for (std::size_t sent = 0; sent < frames.size();) {
    auto [error, size] = stream_->write(frames.data() + sent, frames.size() - sent);
    sent += size;
    if (error == asio::error::would_block) {
      error = co_await wait_to_write();
    } else if (!error) {
      co_await give_way();
    }
    if (stalled_) co_return failed(Kind::stalled, "the peer took no byte for too long");
    if (error) co_return failed(Kind::system, error.message());
  }
  co_return tl::expected<void, ChannelError>();
}

asio::awaitable<void> Channel::drain() {
  stream_->shutdown_send();
  while (true) {
    const error_code error = co_await receive();
    if (error) co_return;
    decoder_ = FrameDecoder();
  }
}

void Channel::shutdown_receive() { stream_->shutdown_receive(); }

void Channel::close() { stream_->close(); }

}  // namespace metamer::wire
