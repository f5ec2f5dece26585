#include "server/service/views/view.h"

#include <algorithm>
#include <limits>

#include "common/scene/probed.h"
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
  if (!later.scene_sha256().empty()) {
    into = later;
    return;
  }
  into.set_revision(later.revision());
  if (later.has_camera()) *into.mutable_camera() = later.camera();
  if (later.has_settings()) *into.mutable_settings() = later.settings();
  merge_by_name(later.light(), *into.mutable_light());
  merge_by_name(later.material(), *into.mutable_material());
  merge_by_name(later.asset(), *into.mutable_asset());
}

v1::WorkerEnvelope frame_order(std::uint64_t id, bool xyz) {
  v1::WorkerEnvelope message;
  message.mutable_next_frame()->set_view_id(id);
  message.mutable_next_frame()->set_xyz(xyz);
  return message;
}

View::View(std::uint64_t id, v1::OpenView open, AssetHolds assets, std::function<void()> wake)
    : id_(id),
      open_(std::move(open)),
      assets_(std::make_unique<AssetHolds>(std::move(assets))),
      size_(size_of(*assets_, open_.scene_sha256())),
      wake_(std::move(wake)) {}

JobSize View::size_of(const AssetHolds& assets, const std::string& scene_sha256) {
  const auto scene = digest_from_bytes(scene_sha256);
  const AssetHolds::Pictures pictures = assets.pictures();
  return {.asset_bytes = assets.bytes(),
          .scene_bytes = scene ? assets.bytes_of(*scene) : 0,
          .picture_values = pictures.values,
          .largest_picture = pictures.largest};
}

JobSize View::size_with(const v1::Plan& plan) const {
  JobSize size = sent_assets_ ? sent_size_ : size_;
  size.pixels = std::uint64_t{plan.width()} * plan.height();
  size.triangles = plan.triangles();
  size.spectra = plan.spectra();
  size.bands = plan.bands();
  return size;
}

std::uint64_t View::memory() const {
  if (ended_) return 0;
  const std::uint64_t other = sent_assets_ ? memory_estimate(sent_size_) : 0;
  const std::uint64_t shown = memory_estimate(size_);
  return shown + std::min(other, std::numeric_limits<std::uint64_t>::max() - shown);
}

std::vector<const AssetHolds*> View::assets() const {
  std::vector<const AssetHolds*> all = {assets_.get()};
  if (sent_assets_) all.push_back(sent_assets_.get());
  return all;
}

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

/// With what is shown, and with a scene that may be in its place.
tl::expected<void, Refusal> View::hold(const v1::AssetName& asset) {
  const auto digest = digest_from_bytes(asset.sha256());
  if (!digest)
    return refuse(v1::Error::LIMIT,
                  "a digest has 32 bytes, not " + std::to_string(asset.sha256().size()));
  for (AssetHolds* const holds : {assets_.get(), sent_assets_.get(), waiting_assets_.get()}) {
    if (holds == nullptr) continue;
    if (!holds->add(*digest))
      return refuse(v1::Error::MISSING_ASSET, "the store lacks " + asset.name());
    if (holds->size() > limits::max_assets)
      return refuse(v1::Error::LIMIT,
                    "a view with more than " + std::to_string(limits::max_assets) + " assets");
  }
  return {};
}

tl::expected<View::Order, Refusal> View::update(const v1::UpdateView& update,
                                                std::unique_ptr<AssetHolds> scene) {
  if (update.scene_sha256().empty())
    for (const v1::AssetName& asset : update.asset())
      if (auto held = hold(asset); !held) return tl::unexpected(held.error());
  v1::UpdateView merged = waiting_ ? *waiting_ : v1::UpdateView();
  merge(update, merged);
  merged.set_view_id(id_);
  if (merged.ByteSizeLong() > wire::max_control_frame)
    return refuse(v1::Error::LIMIT, "the updates that wait are together larger than a message");
  waiting_ = std::move(merged);
  if (scene) {
    waiting_size_ = size_of(*scene, update.scene_sha256());
    waiting_assets_ = std::move(scene);
  }
  return send_waiting();
}

/// The worker has one update at a time.
View::Order View::send_waiting() {
  if (answer_due_ || !waiting_ || ended_) return std::nullopt;
  v1::WorkerEnvelope message;
  *message.mutable_update_view() = *std::exchange(waiting_, std::nullopt);
  answer_due_ = true;
  sent_assets_ = std::move(waiting_assets_);
  sent_size_ = waiting_size_;
  return message;
}

std::vector<v1::WorkerEnvelope> View::frames_due() const {
  std::vector<v1::WorkerEnvelope> frames;
  for (const bool xyz : due_) frames.push_back(frame_order(id_, xyz));
  return frames;
}

tl::expected<View::Order, Refusal> View::next_frame(bool xyz) {
  if (coming_ == max_frame_credits)
    return refuse(v1::Error::LIMIT,
                  "a view has at most " + std::to_string(max_frame_credits) + " frames coming");
  ++coming_;
  due_.push_back(xyz);
  return frame_order(id_, xyz);
}

tl::expected<View::Order, Refusal> View::probe(const v1::Probe& probe) {
  if (probe.x() >= width_ || probe.y() >= height_)
    return refuse(v1::Error::LIMIT, "the place (" + std::to_string(probe.x()) + ", " +
                                        std::to_string(probe.y()) + ") lies outside the view's " +
                                        std::to_string(width_) + "x" + std::to_string(height_) +
                                        " pixels");
  if (probe.side() > max_probe_side)
    return refuse(v1::Error::LIMIT, "a probe's square has at most " +
                                        std::to_string(max_probe_side) + " pixels a side");
  // The worker has begun with the first.
  if (probes_.size() == max_probes) probes_.erase(probes_.begin() + (probe_due_ ? 1 : 0));
  probes_.push_back(probe);
  return send_probe();
}

/// The worker has one probe at a time.
View::Order View::send_probe() {
  if (probe_due_ || probes_.empty() || ended_) return std::nullopt;
  v1::WorkerEnvelope message;
  *message.mutable_probe() = probes_.front();
  probe_due_ = true;
  return message;
}

tl::expected<View::Order, std::string> View::take_probed(v1::ViewEvent event) {
  if (!probe_due_ || event.probed().number() != probes_.front().number())
    return tl::unexpected(std::string("answered a probe that there was not"));
  if (!is_sound(event.probed()))
    return tl::unexpected(std::string("sent a probe's answer that can't be"));
  probe_due_ = false;
  probes_.pop_front();
  add(std::move(event));
  return send_probe();
}

tl::expected<View::Order, std::string> View::take(v1::ViewEvent event) {
  switch (event.event_case()) {
    case v1::ViewEvent::kUpdated:
    case v1::ViewEvent::kRefused:
      if (!answer_due_) return tl::unexpected(std::string("answered an update that there was not"));
      answer_due_ = false;
      if (event.updated().has_plan()) size_ = size_with(event.updated().plan());
      // The scene that was shown is no longer needed, or the one that was refused.
      if (sent_assets_ && event.has_updated()) assets_ = std::move(sent_assets_);
      sent_assets_.reset();
      if (event.updated().has_plan()) {
        width_ = event.updated().plan().width();
        height_ = event.updated().plan().height();
      }
      add(std::move(event));
      return send_waiting();
    case v1::ViewEvent::kBand:
      if (auto sound = check(event.band()); !sound) return tl::unexpected(sound.error());
      add(std::move(event));
      return std::nullopt;
    case v1::ViewEvent::kClosed:
      end(std::move(*event.mutable_closed()));
      return std::nullopt;
    case v1::ViewEvent::kProbed:
      return take_probed(std::move(event));
    case v1::ViewEvent::EVENT_NOT_SET:
      break;
  }
  return tl::unexpected(std::string("sent an event of a view that there is not"));
}

/// Whole rows, one after the other, of a frame that was asked for.
tl::expected<void, std::string> View::check(const v1::FrameBand& band) {
  const std::uint64_t row = std::uint64_t{3} * band.width();
  const bool sound = !due_.empty() && row > 0 && band.rgb().size() % row == 0 &&
                     std::uint64_t{band.width()} * band.height() <= limits::max_view_pixels &&
                     band.first_row() == rows_ && !band.rgb().empty() &&
                     rows_ + band.rgb().size() / row <= band.height();
  if (!sound) return tl::unexpected(std::string("sent a frame that was not asked for"));
  if (rows_ == 0) has_xyz_ = !band.xyz().empty();
  if (band.xyz().size() != (has_xyz_ ? band.rgb().size() * sizeof(float) : 0))
    return tl::unexpected(std::string("sent X Y Z that do not fit the frame"));
  rows_ += static_cast<std::uint32_t>(band.rgb().size() / row);
  if ((rows_ == band.height()) != band.has_frame())
    return tl::unexpected(std::string("sent a frame that does not end with its last row"));
  if (band.has_frame()) {
    if (has_xyz_ != (due_.front() && band.frame().complete()))
      return tl::unexpected(std::string("sent X Y Z that were not asked for, or sent none"));
    rows_ = 0;
    due_.pop_front();
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

/// Of answers to updates the newest is enough; a plan stays until there is a newer one. Of those to
/// probes there are at most max_probes.
void View::add(v1::ViewEvent event) {
  event.set_view_id(id_);
  const auto is_alike = [&](const v1::ViewEvent& one) {
    return !one.has_band() && one.event_case() == event.event_case();
  };
  const auto alike = std::count_if(unsent_.begin(), unsent_.end(), is_alike);
  const bool is_enough = !event.has_probed() || static_cast<std::size_t>(alike) == max_probes;
  const auto older =
      is_enough ? std::find_if(unsent_.begin(), unsent_.end(), is_alike) : unsent_.end();
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
