#include "common/wire/channel.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/wire_format_lite.h>

#include <cassert>
#include <optional>
#include <vector>

#include "metamer/v1/envelope.pb.h"

namespace metamer::wire {

namespace {

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

Channel::Channel(Socket socket, Peer peer)
    : socket_(std::move(socket)), peer_(peer), decoder_(frame_limit(peer)) {}

asio::awaitable<tl::expected<void, ChannelError>> Channel::read(
    google::protobuf::MessageLite& message) {
  while (true) {
    auto payload = decoder_.next();
    if (!payload) co_return failed(Kind::frame, describe(payload.error()));
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

    const auto [error, size] = co_await socket_.async_read_some(
        asio::buffer(received_), asio::as_tuple(asio::use_awaitable));
    if (error == asio::error::eof) {
      if (!decoder_.in_frame()) co_return failed(Kind::closed, "the peer closed the connection");
      co_return failed(Kind::truncated, "the peer closed the connection in mid-frame");
    }
    if (error) co_return failed(Kind::system, error.message());
    decoder_.feed({received_.data(), size});
  }
}

asio::awaitable<tl::expected<void, ChannelError>> Channel::write(
    const google::protobuf::MessageLite& message) {
  co_return co_await write_frames(encode_frame(message.SerializeAsString()));
}

asio::awaitable<tl::expected<void, ChannelError>> Channel::write_frames(std::string frames) {
  const auto [error, size] = co_await asio::async_write(socket_, asio::buffer(frames),
                                                        asio::as_tuple(asio::use_awaitable));
  if (error) co_return failed(Kind::system, error.message());
  assert(size == frames.size());
  co_return tl::expected<void, ChannelError>();
}

asio::awaitable<void> Channel::drain() {
  boost::system::error_code error;
  socket_.shutdown(asio::socket_base::shutdown_send, error);
  while (!error) {
    std::tie(error, std::ignore) = co_await socket_.async_read_some(
        asio::buffer(received_), asio::as_tuple(asio::use_awaitable));
  }
}

void Channel::shutdown_receive() {
  boost::system::error_code ignored;
  socket_.shutdown(asio::socket_base::shutdown_receive, ignored);
}

void Channel::close() {
  boost::system::error_code ignored;
  socket_.close(ignored);
}

}  // namespace metamer::wire
