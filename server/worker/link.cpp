#include "server/worker/link.h"

#include "common/wire/blocking.h"
#include "common/wire/frame.h"

namespace metamer::worker {

bool Link::send(const v1::WorkerEnvelope& message) {
  const std::lock_guard lock(sending_);
  unsent_ += wire::encode_frame(message.SerializeAsString());
  return flush();
}

bool Link::send_with_others(const v1::WorkerEnvelope& message) {
  const std::lock_guard lock(sending_);
  unsent_ += wire::encode_frame(message.SerializeAsString());
  return std::chrono::steady_clock::now() - sent_ < lateness || flush();
}

bool Link::flush() {
  const bool sent = wire::write_frames(descriptor_, unsent_).has_value();
  unsent_.clear();
  sent_ = std::chrono::steady_clock::now();
  return sent;
}

std::optional<v1::WorkerEnvelope> Link::receive() {
  auto message = wire::read_envelope(descriptor_);
  return message ? std::move(*message) : std::nullopt;
}

}  // namespace metamer::worker
