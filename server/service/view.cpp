#include "server/service/view.h"

#include <algorithm>

#include "server/service/limits.h"

namespace metamer::service {

namespace {

/// Each in the place of what has its name, or behind the others.
template <class Item>
void merge_by_name(const google::protobuf::RepeatedPtrField<Item>& later,
                   google::protobuf::RepeatedPtrField<Item>& into) {
  for (const Item& item : later) {
    const auto found = std::find_if(into.begin(), into.end(),
                                    [&](const Item& one) { return one.name() == item.name(); });
    (found != into.end() ? *found : *into.Add()) = item;
  }
}

}  // namespace

void merge(const v1::UpdateView& later, v1::UpdateView& into) {
  into.set_revision(later.revision());
  if (later.has_camera()) *into.mutable_camera() = later.camera();
  if (later.has_settings()) *into.mutable_settings() = later.settings();
  merge_by_name(later.light(), *into.mutable_light());
  merge_by_name(later.material(), *into.mutable_material());
  merge_by_name(later.asset(), *into.mutable_asset());
}

View::View(std::uint64_t id, v1::OpenView open, AssetHolds assets, std::function<void()> wake)
    : id_(id), open_(std::move(open)), assets_(std::move(assets)), wake_(std::move(wake)) {}

v1::WorkerEnvelope View::opening() const {
  v1::WorkerEnvelope message;
  message.mutable_open_view()->set_view_id(id_);
  *message.mutable_open_view()->mutable_open() = open_;
  return message;
}

v1::WorkerEnvelope View::closing() const {
  v1::WorkerEnvelope message;
  message.mutable_close_view()->set_view_id(id_);
  return message;
}

tl::expected<View::Order, Refusal> View::update(const v1::UpdateView& update) {
  for (const v1::AssetName& asset : update.asset()) {
    const auto digest = digest_from_bytes(asset.sha256());
    if (!digest)
      return refuse(v1::Error::LIMIT,
                    "a digest has 32 bytes, not " + std::to_string(asset.sha256().size()));
    if (!assets_.add(*digest))
      return refuse(v1::Error::MISSING_ASSET, "the store lacks " + asset.name());
    if (assets_.size() > limits::max_assets)
      return refuse(v1::Error::LIMIT,
                    "a view with more than " + std::to_string(limits::max_assets) + " assets");
  }
  v1::UpdateView merged = waiting_ ? *waiting_ : v1::UpdateView();
  merged.set_view_id(id_);
  merge(update, merged);
  if (merged.ByteSizeLong() > wire::max_control_frame)
    return refuse(v1::Error::LIMIT, "the updates that wait are together larger than a message");
  waiting_ = std::move(merged);
  return send_waiting();
}

/// The worker has one update at a time.
View::Order View::send_waiting() {
  if (answer_due_ || !waiting_ || ended_) return std::nullopt;
  v1::WorkerEnvelope message;
  *message.mutable_update_view() = *std::exchange(waiting_, std::nullopt);
  answer_due_ = true;
  return message;
}

tl::expected<View::Order, Refusal> View::next_frame() {
  if (coming_ == max_frame_credits)
    return refuse(v1::Error::LIMIT,
                  "a view has at most " + std::to_string(max_frame_credits) + " frames coming");
  ++coming_;
  ++due_;
  v1::WorkerEnvelope message;
  message.mutable_next_frame()->set_view_id(id_);
  return message;
}

tl::expected<View::Order, std::string> View::take(v1::ViewEvent event) {
  switch (event.event_case()) {
    case v1::ViewEvent::kUpdated:
    case v1::ViewEvent::kRefused:
      if (!answer_due_) return tl::unexpected(std::string("answered an update that there was not"));
      answer_due_ = false;
      add(std::move(event));
      return send_waiting();
    case v1::ViewEvent::kBand:
      if (auto sound = check(event.band()); !sound) return tl::unexpected(sound.error());
      add(std::move(event));
      return std::nullopt;
    case v1::ViewEvent::kClosed:
      end(std::move(*event.mutable_closed()));
      return std::nullopt;
    case v1::ViewEvent::EVENT_NOT_SET:
      break;
  }
  return tl::unexpected(std::string("sent an event of a view that there is not"));
}

/// Whole rows, one after the other, of a frame that was asked for.
tl::expected<void, std::string> View::check(const v1::FrameBand& band) {
  const std::uint64_t row = std::uint64_t{3} * band.width();
  const bool sound = due_ > 0 && row > 0 && band.rgb().size() % row == 0 &&
                     std::uint64_t{band.width()} * band.height() <= limits::max_view_pixels &&
                     band.first_row() == rows_ && !band.rgb().empty() &&
                     rows_ + band.rgb().size() / row <= band.height();
  if (!sound) return tl::unexpected(std::string("sent a frame that was not asked for"));
  rows_ += static_cast<std::uint32_t>(band.rgb().size() / row);
  if ((rows_ == band.height()) != band.has_frame())
    return tl::unexpected(std::string("sent a frame that does not end with its last row"));
  if (band.has_frame()) {
    rows_ = 0;
    --due_;
  }
  return {};
}

void View::end(v1::ViewClosed closed) {
  if (ended_) return;
  ended_ = true;
  v1::ViewEvent event;
  *event.mutable_closed() = std::move(closed);
  add(std::move(event));
}

/// Of answers to updates the newest is enough; a plan stays until there is a newer one.
void View::add(v1::ViewEvent event) {
  event.set_view_id(id_);
  const auto older = std::find_if(unsent_.begin(), unsent_.end(), [&](const v1::ViewEvent& one) {
    return !one.has_band() && one.event_case() == event.event_case();
  });
  if (older != unsent_.end()) {
    if (event.has_updated() && !event.updated().has_plan() && older->updated().has_plan())
      *event.mutable_updated()->mutable_plan() = older->updated().plan();
    unsent_.erase(older);
  }
  unsent_.push_back(std::move(event));
  wake_();
}

std::optional<v1::ViewEvent> View::next() {
  if (unsent_.empty()) return std::nullopt;
  std::optional<v1::ViewEvent> event = std::move(unsent_.front());
  unsent_.pop_front();
  if (event->has_band() && event->band().has_frame()) --coming_;
  return event;
}

}  // namespace metamer::service
