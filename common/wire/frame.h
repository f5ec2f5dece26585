#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

/// The frame codec: pure bytes, no sockets, no messages. PROTOCOL.md has the figure.
namespace metamer::wire {

/// A frame is a 4-byte big-endian length and as many bytes.
inline constexpr std::size_t header_size = 4;

/// The largest frame of a small message: protobuf expands up to 128 fold when it is parsed, so
/// 256 KiB cost at most 32 MiB.
inline constexpr std::size_t max_control_frame = 256u << 10;
/// The most data that one chunk of an asset or one tile carries.
inline constexpr std::size_t max_chunk = 4u << 20;
/// The most that a tile's factors take (factors.proto): with its pixels they are one chunk.
inline constexpr std::size_t max_factors = 3u << 20;
/// The largest frame of all: a chunk and the few bytes around it.
inline constexpr std::size_t max_frame = max_chunk + 1024;

enum class FrameError {
  too_large,  ///< The length is above the limit. Nothing was allocated for it.
  empty,      ///< The length is 0: no message is that short.
  tls,        ///< The peer speaks TLS: no frame begins like one of its records.
};
const char* describe(FrameError error);

/// The frame that holds `payload`, which must be at most max_frame bytes (a programmer's mistake
/// otherwise).
std::string encode_frame(std::string_view payload);

/// Takes bytes as they come and gives the payloads out, one frame at a time. Allocates no more than
/// the bytes that have come (rounded up) and never more than `limit`.
class FrameDecoder {
 public:
  explicit FrameDecoder(std::size_t limit = max_frame) : limit_(limit) {}

  /// From the next frame on.
  void set_limit(std::size_t limit) { limit_ = limit; }

  /// Adds received bytes.
  void feed(std::string_view bytes);

  /// The next whole payload; nothing while it is incomplete. After an error the stream can't be
  /// read any further, and every call gives that error.
  tl::expected<std::optional<std::string>, FrameError> next();

  /// How many bytes the next step needs: those that lack to the header, or to the payload whose
  /// length is known. A reader that takes no more than these leaves the next frame alone. 0 when
  /// next() has something to give, or an error.
  std::size_t missing() const;

  /// True when bytes of an unfinished frame are held: the peer stopped in the middle.
  bool in_frame() const { return begin_ < buffer_.size(); }

 private:
  /// The payload's length as the header says it. The header must be there.
  tl::expected<std::size_t, FrameError> payload_size() const;

  std::size_t limit_;
  std::string buffer_;
  std::size_t begin_ = 0;
  std::optional<FrameError> error_;
};

}  // namespace metamer::wire
