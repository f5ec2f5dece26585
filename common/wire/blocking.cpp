#include "common/wire/blocking.h"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "common/wire/frame.h"

namespace metamer::wire {

Result<std::optional<std::string>> read_frame(int fd) {
  FrameDecoder decoder;
  std::array<char, 64 << 10> piece;
  while (true) {
    auto payload = decoder.next();
    if (!payload) return problem(describe(payload.error()));
    if (*payload) return std::move(*payload);

    const ssize_t got = ::read(fd, piece.data(), std::min(piece.size(), decoder.missing()));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return problem(std::string("can't read: ") + std::strerror(errno));
    if (got == 0) {
      if (decoder.in_frame()) return problem("the peer closed the connection in mid-frame");
      return std::nullopt;
    }
    decoder.feed({piece.data(), static_cast<std::size_t>(got)});
  }
}

Result<void> write_frame(int fd, std::string_view payload) {
  return write_frames(fd, encode_frame(payload));
}

Result<void> write_frames(int fd, std::string_view frames) {
  while (!frames.empty()) {
    const ssize_t sent = ::send(fd, frames.data(), frames.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) return problem(std::string("can't write: ") + std::strerror(errno));
    frames.remove_prefix(static_cast<std::size_t>(sent));
  }
  return {};
}

Result<std::optional<v1::WorkerEnvelope>> read_envelope(int fd) {
  auto payload = read_frame(fd);
  if (!payload) return tl::unexpected(payload.error());
  if (!*payload) return std::nullopt;
  v1::WorkerEnvelope envelope;
  if (!envelope.ParseFromString(**payload)) return problem("the frame holds no WorkerEnvelope");
  return envelope;
}

Result<void> write_envelope(int fd, const v1::WorkerEnvelope& envelope) {
  return write_frame(fd, envelope.SerializeAsString());
}

}  // namespace metamer::wire
