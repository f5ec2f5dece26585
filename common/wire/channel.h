#pragma once

#include <google/protobuf/message_lite.h>

#include <boost/asio.hpp>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "common/wire/endpoint.h"
#include "common/wire/frame.h"
#include "common/wire/stream.h"

/// Messages over a stream, with coroutines. Everything on the stream's one thread.
namespace metamer::wire {

/// Who speaks at the other end: that decides which message and which sizes are accepted.
enum class Peer {
  client,  ///< Sends Envelopes; only an AssetChunk may be larger than max_control_frame.
  server,  ///< Sends Envelopes; only a Tile, a Preview or the factors of a Planned may be
           ///< larger than max_control_frame.
  worker,  ///< Sends WorkerEnvelopes of at most max_worker_frame.
};

/// What a worker says is passed on to clients with a few bytes around it, and has to fit there.
inline constexpr std::size_t max_worker_frame = max_control_frame - 1024;

struct ChannelError {
  enum class Kind {
    closed,     ///< The peer closed between two frames: the regular end.
    truncated,  ///< The peer closed inside a frame.
    frame,      ///< A length out of bounds, or bytes that are not the message.
    stalled,    ///< The peer took no byte for too long.
    system,     ///< The connection broke, or was closed on this side.
  };
  Kind kind = Kind::closed;
  std::string message;  ///< For people.
  bool tls = false;     ///< Of `frame`: the peer speaks TLS here.
};

/// Whether a payload above max_control_frame is one of the bulk messages that `peer` may send.
/// Looks at tags and lengths only: a parser would expand hostile bytes up to 128 fold.
bool is_bulk(Peer peer, std::string_view payload);

/// One reader and one writer at a time. The object must outlive its pending operations.
class Channel {
 public:
  Channel(std::unique_ptr<Stream> stream, Peer peer);
  Channel(Socket socket, Peer peer) : Channel(plain_stream(std::move(socket)), peer) {}

  /// Takes no frame of more bytes than this, from the next one on; at first what the peer may send.
  void limit_frames(std::size_t bytes) { decoder_.set_limit(bytes); }
  /// Takes again what the peer may send.
  void lift_frame_limit();
  /// Closes when the peer takes no byte for as long while something is being sent.
  void limit_stall(std::chrono::steady_clock::duration limit) { stall_limit_ = limit; }

  /// Waits for the next message and parses it into `message`: an Envelope, or a WorkerEnvelope
  /// from a worker. After an error nothing more can be read.
  asio::awaitable<tl::expected<void, ChannelError>> read(google::protobuf::MessageLite& message);

  /// Sends `message`, which must fit into a frame (a programmer's mistake otherwise).
  asio::awaitable<tl::expected<void, ChannelError>> write(
      const google::protobuf::MessageLite& message);
  /// The same for frames that encode_frame has made, one behind the other.
  asio::awaitable<tl::expected<void, ChannelError>> write_frames(std::string frames);

  /// Says that nothing more will be sent, then takes what the peer still sends and throws it away,
  /// until it closes too. Closing with bytes unread would take the last answer from the peer.
  asio::awaitable<void> drain();

  /// No more receiving; what has arrived can still be read.
  void shutdown_receive();
  /// Ends every pending operation.
  void close();
  bool is_open() const { return stream_->is_open(); }
  asio::any_io_executor executor() { return stream_->executor(); }
  const Stream& stream() const { return *stream_; }

 private:
  asio::awaitable<boost::system::error_code> receive();
  boost::system::error_code take();
  asio::awaitable<boost::system::error_code> wait_to_write();
  asio::awaitable<void> give_way();

  std::shared_ptr<Stream> stream_;
  Peer peer_;
  FrameDecoder decoder_;
  std::optional<std::chrono::steady_clock::duration> stall_limit_;
  asio::steady_timer stall_;
  bool stalled_ = false;
};

}  // namespace metamer::wire
