// What rays ask Embree: the one place where any reach it.

#include <cmath>
#include <limits>

#include "server/cpu/embree_scene.h"
#include "server/cpu/shared_source.h"

namespace metamer::cpu {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
/// Embree asserts beyond about 1.8e18; validation keeps scenes within 1e15.
constexpr float far_out = 1e18f;

/// The lanes that Embree can take: comparisons with NaN are false.
Int8 finite(const Vec8& origin, const Vec8& direction) {
  const auto within = [](Float8 value, float limit) { return abs(value) <= limit; };
  return within(origin.x, far_out) & within(origin.y, far_out) & within(origin.z, far_out) &
         within(direction.x, far_out) & within(direction.y, far_out) & within(direction.z, far_out);
}

template <class Rays>
void fill(Rays& rays, const Vec8& origin, const Vec8& direction, Float8 length) {
  store(rays.org_x, origin.x);
  store(rays.org_y, origin.y);
  store(rays.org_z, origin.z);
  store(rays.dir_x, direction.x);
  store(rays.dir_y, direction.y);
  store(rays.dir_z, direction.z);
  store(rays.tnear, Float8{});
  store(rays.tfar, length);
  store(rays.time, Float8{});
  for (int i = 0; i < lane_count; ++i) rays.mask[i] = ~0u;
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

Hits EmbreeScene::intersect(const Vec8& origin, const Vec8& direction, Int8 active) const {
  // Ask Embree.
  RTCRayHit8 rays;
  fill(rays.ray, origin, direction, broadcast(infinity));
  for (int i = 0; i < lane_count; ++i) {
    rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  alignas(32) int valid[lane_count];
  const Int8 sound = active & finite(origin, direction);
  store(valid, sound);
  RTCIntersectContext context = coherent_context();
  rtcIntersect8(valid, scene_.get(), &context, &rays);
  return read(rays, origin, direction, sound, nullptr);
}

Hits EmbreeScene::intersect_others(const Vec8& origin, const Vec8& direction, Float8 length,
                                   Int8 active, const Passed& passed) const {
  RTCRayHit8 rays;
  fill(rays.ray, origin, direction, length);
  for (unsigned i = 0; i < lane_count; ++i) {
    rays.ray.id[i] = i;
    rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  alignas(32) int valid[lane_count];
  const Int8 sound = active & finite(origin, direction) & (length >= 0.0f);
  store(valid, sound);
  PassingContext context{coherent_context(), &passed};
  context.embree.filter = leave_out_passed;
  rtcIntersect8(valid, scene_.get(), &context.embree, &rays);
  return read(rays, origin, direction, sound, &passed);
}

/// What was hit.
Hits EmbreeScene::read(const RTCRayHit8& rays, const Vec8& origin, const Vec8& direction,
                       Int8 sound, const Passed* passed) const {
  Hits hits;
  hits.hit = sound & (load(rays.hit.geomID) != static_cast<int>(RTC_INVALID_GEOMETRY_ID));
  hits.distance = load(rays.ray.tfar);
  hits.geometric_normal = {load(rays.hit.Ng_x), load(rays.hit.Ng_y), load(rays.hit.Ng_z)};
  hits.normal = hits.geometric_normal;
  for (int i = 0; i < lane_count; ++i)
    if (hits.hit[i]) shading_normal(rays, i, hits);
  // Embree leaves what it did not hit as it was: anything.
  hits.u = select(hits.hit, load(rays.hit.u), Float8{});
  hits.v = select(hits.hit, load(rays.hit.v), Float8{});
  if (!planes_.empty()) planes_.intersect(origin, direction, sound, passed, hits);
  // Turn the normals to the side that the ray came from.
  hits.geometric_normal = shared::unit(hits.geometric_normal);
  hits.normal = shared::unit(hits.normal);
  const Int8 from_behind = dot(hits.geometric_normal, direction) > 0.0f;
  hits.behind = from_behind & hits.hit;
  hits.geometric_normal =
      select(from_behind, hits.geometric_normal * broadcast(-1), hits.geometric_normal);
  const Int8 opposed = dot(hits.normal, hits.geometric_normal) < 0.0f;
  hits.normal = select(opposed, hits.normal * broadcast(-1), hits.normal);
  hits.inverted = opposed;
  if (tangents_) shading_tangents(hits);
  return hits;
}

Int8 EmbreeScene::visible(const Vec8& origin, const Vec8& direction, Float8 length,
                          Int8 active) const {
  RTCRay8 rays;
  fill(rays, origin, direction, length);
  alignas(32) int valid[lane_count];
  const Int8 sound = active & finite(origin, direction) & (length >= 0.0f);
  store(valid, sound);
  RTCIntersectContext context = coherent_context();
  rtcOccluded8(valid, scene_.get(), &context, &rays);
  // Embree marks what is hidden with a tfar of minus infinity.
  const Int8 free = sound & (load(rays.tfar) >= 0.0f);
  return planes_.empty() ? free : planes_.visible(origin, direction, length, free);
}

}  // namespace metamer::cpu
