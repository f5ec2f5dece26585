#include "server/cpu/normal_maps.h"

#include <Eigen/Geometry>

#include "server/cpu/picture_spot.h"
#include "server/cpu/refraction.h"

namespace metamer::cpu {
namespace {

using Vector = Eigen::Vector3f;

/// Of a turned normal above the surface; lights lower than that are hardly to be seen.
constexpr float least_height = 0.01f;

/// The surface along a picture's own u and v.
struct PictureAxes {
  Vector s = Vector::Zero(), t = Vector::Zero();  ///< Length: of a unit of the picture's.
};

/// Of P(u, v) = P(map(u, v)), by the inverse of the map.
PictureAxes axes_of(const SurfaceAxes& surface, const PlacedPicture& placed) {
  const Vector u(surface.u.data()), v(surface.v.data());
  const auto& m = placed.map;
  const float area = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  if (area == 0) return {};
  return {(u * m[1][1] - v * m[1][0]) / area, (v * m[0][0] - u * m[0][1]) / area};
}

/// Not unit; `normal` where the UVs have no direction.
Vector by_normals(const RenderMap& map, const PictureSpot& spot, const SurfaceAxes& surface,
                  const Vector& normal) {
  const PictureAxes axes = axes_of(surface, map.placed);
  const Vector along = axes.s - normal * normal.dot(axes.s);
  const float length = along.norm();
  if (!(length > 0 && std::isfinite(length))) return normal;
  const Vector x = along / length;
  Vector y = normal.cross(x);
  if (y.dot(axes.t) < 0) y = -y;

  const auto [s, t] = map.placed.at(spot.u, spot.v);
  std::array<float, 3> n{};
  add_weights(map.placed.picture, map.placed.wrap, s, t, map.placed.level(spot.covered, spot.slant),
              n.data());
  for (float& value : n) value = (value * 65535 - 32768) / 32767;
  constexpr float flattest = 1e-3f;
  const auto strength = static_cast<float>(map.strength);
  return x * (strength * n[0]) + y * (strength * n[1]) + normal * std::max(n[2], flattest);
}

/// The gradient of the heights along the surface.
Vector slope(const RenderMap& map, const PictureSpot& spot, const SurfaceAxes& surface,
             const Vector& normal) {
  const PictureAxes axes = axes_of(surface, map.placed);
  const float area = normal.dot(axes.s.cross(axes.t));
  if (!(std::abs(area) > 0 && std::isfinite(area))) return Vector::Zero();

  const TexturePicture& picture = map.placed.picture;
  const auto last = static_cast<float>(picture.levels.size() - 1);
  const float seen = map.placed.level(spot.covered, spot.slant);
  const float level = seen > 0 ? std::min(seen, last) : 0.0f;
  const float pixels = std::exp2(level);
  const auto [s, t] = map.placed.at(spot.u, spot.v);
  const auto height = [&](float at_s, float at_t) {
    float sum = 0;
    add_weights(picture, map.placed.wrap, at_s, at_t, level, &sum);
    return sum;
  };
  const auto scale = static_cast<float>(map.height);
  const float ds = pixels / static_cast<float>(picture.levels.front().width),
              dt = pixels / static_cast<float>(picture.levels.front().height);
  const float by_s = scale * (height(s + ds / 2, t) - height(s - ds / 2, t)) / ds,
              by_t = scale * (height(s, t + dt / 2) - height(s, t - dt / 2)) / dt;
  return (axes.t.cross(normal) * by_s + normal.cross(axes.s) * by_t) / area;
}

}  // namespace

NormalMaps::NormalMaps(const RenderScene& scene, const EmbreeScene& geometry, float footprint)
    : scene_(scene), geometry_(geometry), footprint_(footprint) {
  for (const RenderMaterial& material : scene.materials) needed_ |= material.turns_normals();
}

void NormalMaps::turn(const Packet& packet, Hits& hits) const {
  for (unsigned i = 0; i < lane_count; ++i) {
    if (!packet.active[i]) continue;
    const auto& material = scene_.materials[static_cast<std::size_t>(hits.material[i])];
    if (!material.turns_normals()) continue;
    const PictureSpot spot = picture_spot(geometry_, packet, hits, i, footprint_);
    const SurfaceAxes surface = geometry_.surface_axes(
        hits.object[i], hits.primitive[i], {packet.hit.x[i], packet.hit.y[i], packet.hit.z[i]});
    // Pictures lie on the front: what is a hill there is a valley from behind.
    const float side = (hits.inverted[i] != 0) == surface.mirrored ? 1.0f : -1.0f;
    const Vector front = side * lane_of(hits.normal, i);
    Vector turned = front;
    if (material.normal_map)
      turned = by_normals(scene_.maps[*material.normal_map], spot, surface, front);
    if (material.bump_map)
      turned -= turned.dot(front) * slope(scene_.maps[*material.bump_map], spot, surface, front);
    turned = side * turned.normalized();
    if (!turned.allFinite()) continue;
    const Vector above = lane_of(hits.geometric_normal, i);
    if (const float height = turned.dot(above); height < least_height)
      turned = (turned + above * (least_height - height)).normalized();
    set_lane(hits.normal, turned, i);
  }
}

}  // namespace metamer::cpu
