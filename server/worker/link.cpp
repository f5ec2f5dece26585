#include "server/worker/link.h"

#include "common/wire/blocking.h"

namespace metamer::worker {

bool Link::send(const v1::WorkerEnvelope& message) {
  const std::lock_guard lock(sending_);
  return wire::write_envelope(descriptor_, message).has_value();
}

std::optional<v1::WorkerEnvelope> Link::receive() {
  auto message = wire::read_envelope(descriptor_);
  return message ? std::move(*message) : std::nullopt;
}

}  // namespace metamer::worker
