#include "server/cpu/triangle_places.h"

#include "server/cpu/angles.h"

namespace metamer::cpu {
namespace {

using Triple = std::array<float, 3>;

/// The edges whose middles QUADRATIC looks at.
constexpr std::array<std::array<std::size_t, 2>, 3> edges = {{{0, 1}, {0, 2}, {1, 2}}};

void set(Vec8& to, int lane, const Triple& v) {
  to.x[lane] = v[0];
  to.y[lane] = v[1];
  to.z[lane] = v[2];
}

/// The middle of two corners, the same whichever is named first: no seam between two triangles.
Triple middle(const Triple& a, const Triple& b) {
  return {0.5f * (a[0] + b[0]), 0.5f * (a[1] + b[1]), 0.5f * (a[2] + b[2])};
}

Triple unit(const Triple& v) {
  const float squared = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  const float scale = squared > 0 ? 1 / std::sqrt(squared) : 0;
  return {scale * v[0], scale * v[1], scale * v[2]};
}

void fill_corners(const Corners& corners, TrianglePlaces& places) {
  for (std::size_t i = 0; i < 3; ++i) {
    const int lane = static_cast<int>(i);
    set(places.position, lane, corners.position[i]);
    set(places.normal, lane, corners.normal[i]);
    set(places.tangent, lane, corners.tangent[i]);
  }
}

void fill_middles(const Corners& corners, TrianglePlaces& places) {
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const int lane = static_cast<int>(3 + e);
    const auto [a, b] = edges[e];
    set(places.position, lane, middle(corners.position[a], corners.position[b]));
    // Of unit normals, so that a long one does not outweigh its neighbour.
    set(places.normal, lane, middle(unit(corners.normal[a]), unit(corners.normal[b])));
    set(places.tangent, lane, middle(corners.tangent[a], corners.tangent[b]));
  }
}

Triple mean(const std::array<Triple, 3>& v) {
  Triple sum{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    sum[axis] = (v[0][axis] + v[1][axis] + v[2][axis]) / 3;
  return sum;
}

void fill_rest(TrianglePlaces& places) {
  for (Vec8* v : {&places.position, &places.normal, &places.tangent})
    for (int lane = places.count; lane < lane_count; ++lane)
      set(*v, lane, {v->x[0], v->y[0], v->z[0]});
}

}  // namespace

TrianglePlaces triangle_places(v1::Shading shading, const Corners& corners, const Triple& side) {
  TrianglePlaces places{};
  if (shading == v1::CONSTANT) {
    set(places.position, 0, mean(corners.position));
    set(places.normal, 0, side);
    set(places.tangent, 0, mean(corners.tangent));
    places.count = 1;
  } else {
    fill_corners(corners, places);
    places.count = 3;
    if (shading == v1::QUADRATIC) {
      fill_middles(corners, places);
      places.count = 6;
    }
  }
  fill_rest(places);

  // A corner without a normal has the triangle's.
  const Vec8 flat = metamer::broadcast(side);
  places.normal = normalize(places.normal);
  const Int8 none = dot(places.normal, places.normal) == 0.0f;
  places.normal = select(none, flat, places.normal);
  const Int8 behind = dot(places.normal, flat) < 0.0f;
  places.normal = select(behind, places.normal * metamer::broadcast(-1), places.normal);
  places.tangent =
      steady_tangent(places.normal, places.tangent, metamer::broadcast(corners.across));
  return places;
}

std::array<Float8, max_places> place_weights(v1::Shading shading, Float8 u, Float8 v) {
  const Float8 w = 1.0f - u - v;
  if (shading == v1::CONSTANT) return {metamer::broadcast(1)};
  if (shading == v1::GOURAUD) return {w, u, v};
  return {w * (2.0f * w - 1.0f), u * (2.0f * u - 1.0f), v * (2.0f * v - 1.0f),
          4.0f * w * u,          4.0f * w * v,          4.0f * u * v};
}

}  // namespace metamer::cpu
