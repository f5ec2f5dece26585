// What Embree's answers mean. It says which surface a ray meets; where is computed here, by
// operations that are the same on every processor: Embree's own distances and barycentric
// coordinates are products with an approximate 1/x, which each of its ISAs has in its own way.

#include <bit>
#include <cmath>

#include "server/cpu/embree_scene.h"
#include "server/cpu/shared_source.h"

namespace metamer::cpu {
namespace {

Float3 times(const std::array<Float3, 3>& rows, const Float3& v) {
  Float3 to;
  for (std::size_t i = 0; i < 3; ++i)
    to[i] = rows[i][0] * v[0] + rows[i][1] * v[1] + rows[i][2] * v[2];
  return to;
}
Float3 times(const std::array<std::array<float, 4>, 3>& rows, const Float3& v) {
  Float3 to;
  for (std::size_t i = 0; i < 3; ++i)
    to[i] = rows[i][0] * v[0] + rows[i][1] * v[1] + rows[i][2] * v[2] + rows[i][3];
  return to;
}

Vectors cross(const Vectors& a, const Vectors& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Floats within_one(Floats a) { return min(max(a, Floats{}), metamer::broadcast(1)); }

}  // namespace

/// The triangles of lanes, in the world.
struct EmbreeScene::MetTriangles {
  Ints lanes{};        ///< That have hit one.
  Ints smooth{};       ///< Whose corners have normals.
  Ints instance{};     ///< Of an object that shares its mesh.
  Vectors a, b, c;     ///< Corners.
  Vectors normal;      ///< Of an instance: as its mesh's own is mapped.
  Vectors na, nb, nc;  ///< At the corners.
};

/// T. Möller and B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", J. Graphics Tools
/// 2(1), 1997: by Embree's own formulas, with a division in place of its approximate reciprocal.
void EmbreeScene::meet_triangles(const MetTriangles& met, const Vectors& origin,
                                 const Vectors& direction, Hits& hits) {
  hits.normal = hits.geometric_normal;
  if (!any(met.lanes)) return;
  const Vectors from_b = met.a - met.b, to_c = met.c - met.a, to_a = met.a - origin;
  const Vectors normal = cross(to_c, from_b), turned = cross(to_a, direction);
  const Floats below = dot(normal, direction);
  // Where rounding leaves nothing of a triangle that is seen from its edge, Embree's answer stays.
  const Ints sound = met.lanes & (abs(below) > 0.0f);
  hits.distance = select(sound, max(dot(normal, to_a) / below, Floats{}), hits.distance);
  hits.u = select(sound, within_one(dot(turned, to_c) / below), hits.u);
  hits.v = select(sound, within_one(dot(turned, from_b) / below), hits.v);
  hits.geometric_normal = select(met.lanes, normal, hits.geometric_normal);
  if (any(met.instance))
    hits.geometric_normal = select(met.instance, met.normal, hits.geometric_normal);

  // Interpolate the corners' normals; E: n = (1 − u − v) n₀ + u n₁ + v n₂.
  hits.normal = hits.geometric_normal;
  if (!any(met.smooth)) return;
  const Vectors between = met.na * (1.0f - hits.u - hits.v) + met.nb * hits.u + met.nc * hits.v;
  hits.normal = select(met.smooth, between, hits.normal);
}

/// A sphere before its map: where |o + t d|² = r², on the side that Embree has found.
void EmbreeScene::meet_sphere(const Placed& placed, const Vectors& origin, const Vectors& direction,
                              unsigned i, Hits& hits) {
  const Ball& ball = placed.ball;
  const Float3 d = times(ball.from_world, {direction.x[i], direction.y[i], direction.z[i]});
  const Float3 o = times(
      ball.from_world,
      {origin.x[i] - ball.center[0], origin.y[i] - ball.center[1], origin.z[i] - ball.center[2]});
  const float squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  const float middle = -(o[0] * d[0] + o[1] * d[1] + o[2] * d[2]) / squared;
  Float3 off;
  for (std::size_t axis = 0; axis < 3; ++axis) off[axis] = o[axis] + middle * d[axis];
  const float left =
      ball.radius * ball.radius - (off[0] * off[0] + off[1] * off[1] + off[2] * off[2]);
  const float half = std::sqrt(std::max(left, 0.0f) / squared);
  const float t = hits.distance[i] < middle ? middle - half : middle + half;
  if (!std::isfinite(t)) return;
  hits.distance[i] = std::max(t, 0.0f);
  for (std::size_t axis = 0; axis < 3; ++axis) off[axis] += (hits.distance[i] - middle) * d[axis];
  // A normal goes by the transpose of what maps from the world.
  Float3 normal;
  for (std::size_t axis = 0; axis < 3; ++axis)
    normal[axis] = ball.from_world[0][axis] * off[0] + ball.from_world[1][axis] * off[1] +
                   ball.from_world[2][axis] * off[2];
  hits.geometric_normal.x[i] = normal[0];
  hits.geometric_normal.y[i] = normal[1];
  hits.geometric_normal.z[i] = normal[2];
}

/// What lanes have hit that have all hit the same as the `first` of them, but for where.
void EmbreeScene::find(const RayHits& rays, unsigned first, Ints same, MetTriangles& met,
                       Hits& hits) const {
  const unsigned instance = rays.hit.instID[0][first];
  const unsigned object = instance != RTC_INVALID_GEOMETRY_ID ? instance : rays.hit.geomID[first];
  const Placed& placed = placed_[object];
  hits.object = same ? Ints{} + static_cast<int>(object) : hits.object;
  hits.material = same ? Ints{} + static_cast<int>(placed.material) : hits.material;
  if (interpolated_ && placed.shading != v1::PHONG) hits.interpolated |= same;
  if (placed.mesh == nullptr) return;

  // The first one is every lane's until others come.
  const auto setter = [same](Ints before) {
    return [same, first = !any(before)](Vectors& to, const Float3& v) {
      to = first ? metamer::broadcast(v) : select(same, metamer::broadcast(v), to);
    };
  };
  const auto set = setter(met.lanes), set_normal = setter(met.smooth),
             set_own = setter(met.instance);
  met.lanes |= same;
  const Triangle& corner = placed.mesh->triangles[rays.hit.primID[first]];
  const Float3 &a = placed.vertices[corner[0]], &b = placed.vertices[corner[1]],
               &c = placed.vertices[corner[2]];
  const Float3* const normals = placed.normals;
  if (normals != nullptr) met.smooth |= same;
  if (!placed.instance) {
    set(met.a, a), set(met.b, b), set(met.c, c);
    if (normals == nullptr) return;
    set_normal(met.na, normals[corner[0]]), set_normal(met.nb, normals[corner[1]]);
    set_normal(met.nc, normals[corner[2]]);
    return;
  }
  met.instance |= same;
  set(met.a, times(placed.to_world, a));
  set(met.b, times(placed.to_world, b));
  set(met.c, times(placed.to_world, c));
  Float3 u, v;
  for (std::size_t axis = 0; axis < 3; ++axis) u[axis] = b[axis] - a[axis];
  for (std::size_t axis = 0; axis < 3; ++axis) v[axis] = c[axis] - a[axis];
  const Float3 normal = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                         u[0] * v[1] - u[1] * v[0]};
  set_own(met.normal, times(placed.to_world_normals, normal));
  if (normals == nullptr) return;
  set_normal(met.na, times(placed.to_world_normals, normals[corner[0]]));
  set_normal(met.nb, times(placed.to_world_normals, normals[corner[1]]));
  set_normal(met.nc, times(placed.to_world_normals, normals[corner[2]]));
}

Hits EmbreeScene::read(const RayHits& rays, const Vectors& origin, const Vectors& direction,
                       Ints sound, const Passed* passed) const {
  Hits hits;
  hits.hit = sound & (load(rays.hit.geomID) != static_cast<int>(RTC_INVALID_GEOMETRY_ID));
  hits.distance = load(rays.ray.tfar);
  hits.geometric_normal = {load(rays.hit.Ng_x), load(rays.hit.Ng_y), load(rays.hit.Ng_z)};
  // Embree leaves what it did not hit as it was: anything.
  hits.u = select(hits.hit, load(rays.hit.u), Floats{});
  hits.v = select(hits.hit, load(rays.hit.v), Floats{});
  // Look each surface up once for all of its lanes.
  const Ints primitive = load(rays.hit.primID), geometry = load(rays.hit.geomID),
             instance = load(rays.hit.instID[0]);
  hits.primitive = hits.hit & primitive;
  MetTriangles met;
  for (Ints left = hits.hit; any(left);) {
    const auto first = static_cast<unsigned>(std::countr_zero(bits(left)));
    const Ints same = left & (primitive == primitive[first]) & (geometry == geometry[first]) &
                      (instance == instance[first]);
    find(rays, first, same, met, hits);
    left &= ~same;
  }
  for (unsigned rest = bits(hits.hit & ~met.lanes); rest != 0; rest &= rest - 1) {
    const auto i = static_cast<unsigned>(std::countr_zero(rest));
    meet_sphere(placed_[static_cast<std::size_t>(hits.object[i])], origin, direction, i, hits);
  }
  meet_triangles(met, origin, direction, hits);
  if (!planes_.empty()) planes_.intersect(origin, direction, sound, passed, hits);
  // Turn the normals to the side that the ray came from.
  hits.geometric_normal = shared::unit(hits.geometric_normal);
  hits.normal = shared::unit(hits.normal);
  const Ints from_behind = dot(hits.geometric_normal, direction) > 0.0f;
  hits.behind = from_behind & hits.hit;
  hits.geometric_normal =
      select(from_behind, hits.geometric_normal * broadcast(-1), hits.geometric_normal);
  const Ints opposed = dot(hits.normal, hits.geometric_normal) < 0.0f;
  hits.normal = select(opposed, hits.normal * broadcast(-1), hits.normal);
  hits.inverted = opposed;
  if (tangents_) shading_tangents(hits);
  return hits;
}

}  // namespace metamer::cpu
