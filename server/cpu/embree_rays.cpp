// What rays ask Embree: the one place where any reach it.

#include <cmath>
#include <cstring>
#include <limits>

#include "server/cpu/embree_scene.h"
#include "server/cpu/shared_source.h"

namespace metamer::cpu {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
/// Embree asserts beyond about 1.8e18; validation keeps scenes within 1e15.
constexpr float far_out = 1e18f;

/// The lanes that Embree can take: comparisons with NaN are false.
Ints finite(const Vectors& origin, const Vectors& direction) {
  const auto within = [](Floats value, float limit) { return abs(value) <= limit; };
  return within(origin.x, far_out) & within(origin.y, far_out) & within(origin.z, far_out) &
         within(direction.x, far_out) & within(direction.y, far_out) & within(direction.z, far_out);
}

/// `first`: the lane of the packet's first ray, which has as many as Embree's type.
template <class Packet>
void fill(Packet& rays, const Vectors& origin, const Vectors& direction, Floats length,
          std::size_t first = 0) {
  constexpr std::size_t bytes = sizeof rays.tfar;
  const auto put = [first](float* to, const Floats& from) {
    std::memcpy(to, reinterpret_cast<const char*>(&from) + first * sizeof(float), bytes);
  };
  put(rays.org_x, origin.x);
  put(rays.org_y, origin.y);
  put(rays.org_z, origin.z);
  put(rays.dir_x, direction.x);
  put(rays.dir_y, direction.y);
  put(rays.dir_z, direction.z);
  put(rays.tfar, length);
  std::memset(rays.tnear, 0, bytes);
  std::memset(rays.time, 0, bytes);
  std::memset(rays.mask, 0xff, bytes);
}

RTCIntersectContext coherent_context() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

/// Embree hands its first member on.
struct PassingContext {
  RTCIntersectContext embree;
  const Passed* passed;
};

void leave_out_passed(const RTCFilterFunctionNArguments* arguments) {
  const Passed& passed = *reinterpret_cast<const PassingContext*>(arguments->context)->passed;
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (arguments->valid[i] == 0) continue;
    const unsigned instance = RTCHitN_instID(arguments->hit, arguments->N, i, 0);
    const unsigned object = instance != RTC_INVALID_GEOMETRY_ID
                                ? instance
                                : RTCHitN_geomID(arguments->hit, arguments->N, i);
    const unsigned primitive = RTCHitN_primID(arguments->hit, arguments->N, i);
    if (passed.has(RTCRayN_id(arguments->ray, arguments->N, i), static_cast<int>(object),
                   static_cast<int>(primitive)))
      arguments->valid[i] = 0;
  }
}

}  // namespace

Hits EmbreeScene::intersect(const Vectors& origin, const Vectors& direction, Ints active) const {
  // Ask Embree.
  RayHits rays;
  fill(rays.ray, origin, direction, broadcast(infinity));
  for (int i = 0; i < lane_count; ++i) {
    rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  alignas(Ints) int valid[lane_count];
  const Ints sound = active & finite(origin, direction);
  store(valid, sound);
  RTCIntersectContext context = coherent_context();
  EmbreePacket<lane_count>::intersect(valid, scene_.get(), &context, &rays);
  return read(rays, origin, direction, sound, nullptr);
}

Hits EmbreeScene::intersect_others(const Vectors& origin, const Vectors& direction, Floats length,
                                   Ints active, const Passed& passed) const {
  RayHits rays;
  fill(rays.ray, origin, direction, length);
  for (unsigned i = 0; i < lane_count; ++i) {
    rays.ray.id[i] = i;
    rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  alignas(Ints) int valid[lane_count];
  const Ints sound = active & finite(origin, direction) & (length >= 0.0f);
  store(valid, sound);
  PassingContext context{coherent_context(), &passed};
  context.embree.filter = leave_out_passed;
  EmbreePacket<lane_count>::intersect(valid, scene_.get(), &context.embree, &rays);
  return read(rays, origin, direction, sound, &passed);
}

Ints EmbreeScene::visible(const Vectors& origin, const Vectors& direction, Floats length,
                          Ints active) const {
  const Ints sound = active & finite(origin, direction) & (length >= 0.0f);
  RTCIntersectContext context = coherent_context();
  // By groups, whatever the number of lanes: of some coherent packets of 16 shadow rays
  // Embree 3.13.5 never makes an end, and those that are not take longer than two coherent ones
  // of 8.
  alignas(Ints) int valid[lane_count];
  std::array<LaneGroup, group_count> far;
  far.fill(LaneGroup{} - 1);
  store(valid, sound);
  for (unsigned group = 0; group < group_count; ++group) {
    if (!any_of(sound, group)) continue;
    const std::size_t first = group * group_size;
    RTCRay8 rays;
    fill(rays, origin, direction, length, first);
    rtcOccluded8(valid + first, scene_.get(), &context, &rays);
    std::memcpy(&far[group], rays.tfar, sizeof rays.tfar);
  }
  // Embree marks what is hidden with a tfar of minus infinity.
  const Ints free = sound & (join(far) >= 0.0f);
  return planes_.empty() ? free : planes_.visible(origin, direction, length, free);
}

}  // namespace metamer::cpu
