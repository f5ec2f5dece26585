#include "common/wire/frame.h"

#include <algorithm>
#include <cassert>

namespace metamer::wire {

const char* describe(FrameError error) {
  switch (error) {
    case FrameError::too_large:
      return "the frame's length is over the limit";
    case FrameError::empty:
      return "the frame's length is 0";
    case FrameError::tls:
      return "these bytes are TLS, not a frame";
  }
  return "unknown frame error";
}

std::string encode_frame(std::string_view payload) {
  assert(!payload.empty() && payload.size() <= max_frame);
  const auto length = static_cast<std::uint32_t>(payload.size());
  std::string frame;
  frame.reserve(header_size + payload.size());
  for (const unsigned shift : {24u, 16u, 8u, 0u}) {
    frame.push_back(static_cast<char>(static_cast<unsigned char>(length >> shift)));
  }
  frame.append(payload);
  return frame;
}

void FrameDecoder::feed(std::string_view bytes) {
  if (error_) return;

  // Move the rest to the front once it is the smaller part: each byte moves once on average.
  if (begin_ > 0 && begin_ >= buffer_.size() - begin_) {
    buffer_.erase(0, begin_);
    begin_ = 0;
  }
  buffer_.append(bytes);
}

tl::expected<std::size_t, FrameError> FrameDecoder::payload_size() const {
  std::size_t size = 0;
  for (std::size_t i = 0; i < header_size; ++i) {
    size = size << 8 | static_cast<unsigned char>(buffer_[begin_ + i]);
  }
  if (size == 0) return tl::unexpected(FrameError::empty);
  // A handshake or an alert, of version 3.x (RFC 8446, 5.1): far above any limit here.
  if (const std::size_t record = size >> 16; record == 0x1603 || record == 0x1503)
    return tl::unexpected(FrameError::tls);
  if (size > limit_) return tl::unexpected(FrameError::too_large);
  return size;
}

tl::expected<std::optional<std::string>, FrameError> FrameDecoder::next() {
  if (error_) return tl::unexpected(*error_);
  const std::size_t held = buffer_.size() - begin_;
  if (held < header_size) return std::nullopt;

  // Judge the length before anything is done for its sake.
  const auto size = payload_size();
  if (!size) {
    error_ = size.error();
    std::string().swap(buffer_);
    begin_ = 0;
    return tl::unexpected(*error_);
  }
  if (held - header_size < *size) return std::nullopt;

  std::string payload = buffer_.substr(begin_ + header_size, *size);
  begin_ += header_size + *size;
  if (begin_ == buffer_.size()) {
    buffer_.clear();
    begin_ = 0;
    // A chunk's room is not kept for the small messages that follow it.
    if (buffer_.capacity() > max_control_frame) buffer_.shrink_to_fit();
  }
  return payload;
}

std::size_t FrameDecoder::missing() const {
  if (error_) return 0;
  const std::size_t held = buffer_.size() - begin_;
  if (held < header_size) return header_size - held;
  const auto size = payload_size();
  if (!size) return 0;
  return header_size + *size - std::min(held, header_size + *size);
}

}  // namespace metamer::wire
