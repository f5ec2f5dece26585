#include "server/cpu/lens.h"

#include <algorithm>

#include "server/cpu/shared_source.h"
#include "server/cpu/soft/around.h"
#include "server/cpu/soft/pattern.h"

namespace metamer::cpu {
namespace {

/// Of the lens, among what a pixel's seed is hashed with: lights have their numbers.
constexpr std::uint32_t lens_number = 0xffffffff;

}  // namespace

Lens::Lens(const RenderCamera& camera)
    : radius_(static_cast<float>(camera.aperture_radius)),
      per_focus_(static_cast<float>(std::min(1 / camera.focus_distance, 1e38))),
      right_(to_lanes(camera.right)),
      up_(to_lanes(camera.up)) {}

void Lens::put_rays(const Vectors& way, Packet& packet) const {
  soft::Points point;
  for (unsigned i = 0; i < lane_count; ++i)
    soft::Pattern{packet.sample[i], soft::hashed(packet.seed[i], lens_number)}.shuffled().put(point,
                                                                                              i);
  // Even over the disk.
  Floats x, y;
  soft::turn(point.v, x, y);
  const Floats radius = radius_ * sqrt(point.u);
  const Vectors offset = right_ * (radius * x) + up_ * (radius * y);
  packet.origin = packet.origin + offset;
  packet.direction = shared::unit(way - offset * metamer::broadcast(per_focus_));
  packet.from_lens = true;
}

}  // namespace metamer::cpu
