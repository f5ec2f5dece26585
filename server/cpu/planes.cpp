#include "server/cpu/planes.h"

#include "server/cpu/embree_scene.h"

namespace metamer::cpu {
namespace {

/// A plane so far away can't be told from its horizon, and what lies there is beyond f32's squares.
constexpr float horizon = 1e15F;

Floats distance_to(const Vectors& normal, Floats height, const Vectors& origin,
                   const Vectors& direction) {
  return (height - dot(normal, origin)) / dot(normal, direction);
}

}  // namespace

void Planes::add(std::uint32_t number, const RenderObject& object) {
  // A normal goes by the inverse transpose.
  const Eigen::Vector3d normal =
      (object.to_world.linear().inverse().transpose() * Eigen::Vector3d::UnitY()).normalized();
  planes_.push_back({static_cast<int>(number), static_cast<int>(object.material), to_lanes(normal),
                     broadcast(static_cast<float>(normal.dot(object.to_world.translation())))});
}

void Planes::intersect(const Vectors& origin, const Vectors& direction, Ints active,
                       const Passed* passed, Hits& hits) const {
  for (const Plane& plane : planes_) {
    const Floats distance = distance_to(plane.normal, plane.height, origin, direction);
    Ints met = active & (distance > 0.0f) & (distance < horizon) & (distance < hits.distance);
    for (unsigned i = 0; passed != nullptr && i < lane_count; ++i)
      if (passed->has(i, plane.object, 0)) met[i] = 0;
    hits.hit |= met;
    hits.distance = select(met, distance, hits.distance);
    hits.geometric_normal = select(met, plane.normal, hits.geometric_normal);
    hits.normal = select(met, plane.normal, hits.normal);
    hits.object = met ? Ints{} + plane.object : hits.object;
    hits.material = met ? Ints{} + plane.material : hits.material;
    hits.primitive &= ~met;
    hits.interpolated &= ~met;
    hits.u = select(met, Floats{}, hits.u);
    hits.v = select(met, Floats{}, hits.v);
  }
}

Ints Planes::visible(const Vectors& origin, const Vectors& direction, Floats length,
                     Ints free) const {
  for (const Plane& plane : planes_) {
    const Floats distance = distance_to(plane.normal, plane.height, origin, direction);
    free &= ~((distance > 0.0f) & (distance < length));
  }
  return free;
}

}  // namespace metamer::cpu
