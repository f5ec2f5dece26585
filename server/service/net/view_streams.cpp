#include "server/service/net/view_streams.h"

#include <utility>

namespace metamer::service {

ViewPtr ViewStreams::find(std::uint64_t view_id) const {
  for (const Stream& stream : streams_)
    if (stream.view->id() == view_id) return stream.view;
  return nullptr;
}

void ViewStreams::clear() {
  for (const Stream& stream : std::exchange(streams_, {})) close_(*stream.view);
}

std::optional<v1::Envelope> ViewStreams::next() {
  for (std::size_t asked = 0; asked < streams_.size(); ++asked) {
    turn_ = (turn_ + 1) % streams_.size();
    const Stream stream = streams_[turn_];
    auto event = stream.view->next();
    if (!event) continue;
    if (event->has_closed()) {
      streams_.erase(streams_.begin() + static_cast<std::ptrdiff_t>(turn_));
      close_(*stream.view);
    }
    v1::Envelope envelope;
    envelope.set_request_id(stream.request_id);
    *envelope.mutable_view_event() = *std::move(event);
    return envelope;
  }
  return std::nullopt;
}

}  // namespace metamer::service
