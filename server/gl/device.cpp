#include "server/gl/device.h"

#include <algorithm>

#include "server/gl/canary.h"

namespace metamer::gl {

Result<Device> Device::create(const std::string& which) {
  auto context = Context::create(which);
  if (!context) return tl::unexpected(context.error());
  Device device(std::move(*context));
  auto capabilities = examine(device.context_);
  if (!capabilities) return tl::unexpected(capabilities.error());
  device.capabilities_ = std::move(*capabilities);
  return device;
}

Result<std::shared_ptr<const Geometry>> Device::geometry(const std::string& key,
                                                         const RenderScene& scene,
                                                         const std::atomic<bool>& cancelled) {
  const auto found =
      std::find_if(known_.begin(), known_.end(), [&](const Known& one) { return one.key == key; });
  if (found != known_.end()) {
    known_.splice(known_.begin(), known_, found);
    return found->geometry;
  }
  // Make room before, not after: the GPU's memory may hold one large scene only.
  while (known_.size() >= most) known_.pop_back();
  ++uploads_;
  auto geometry = Geometry::upload(scene, cancelled);
  if (!geometry && !known_.empty() && !cancelled) {
    known_.clear();
    geometry = Geometry::upload(scene, cancelled);
  }
  if (!geometry) return tl::unexpected(geometry.error());
  known_.push_front({key, std::make_shared<const Geometry>(std::move(*geometry))});
  return known_.front().geometry;
}

}  // namespace metamer::gl
