// What an EmbreeScene knows of a point on a surface: tangents, corners, UVs.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "server/cpu/embree_scene.h"
#include "server/cpu/shared_source.h"

namespace metamer::cpu {
namespace {

constexpr std::array<float, 3> x_axis = {1, 0, 0}, z_axis = {0, 0, 1};

/// A point (w = 1) or a direction (w = 0) in the world.
std::array<float, 3> mapped(const std::array<std::array<float, 4>, 3>& map,
                            const std::array<float, 3>& v, float w) {
  std::array<float, 3> to;
  for (std::size_t row = 0; row < 3; ++row)
    to[row] = map[row][0] * v[0] + map[row][1] * v[1] + map[row][2] * v[2] + map[row][3] * w;
  return to;
}

/// A triangle in the world and on a picture.
struct UvTriangle {
  std::array<Eigen::Vector2f, 3> uv;
  std::array<Eigen::Vector3f, 3> place;
};
UvTriangle uv_triangle(const TriangleMesh& mesh, std::size_t primitive, const Corners& where) {
  UvTriangle to;
  for (std::size_t i = 0; i < 3; ++i) {
    to.uv[i] = Eigen::Vector2f(mesh.uvs[mesh.triangles[primitive][i]].data());
    to.place[i] = Eigen::Vector3f(where.position[i].data());
  }
  return to;
}

}  // namespace

/// From the mesh's UVs, else the object's x axis, in the world.
std::array<float, 3> EmbreeScene::corner_tangent(const Placed& placed, std::uint32_t vertex) const {
  std::array<float, 3> tangent{};
  if (placed.mesh != nullptr && !placed.mesh->tangents.empty())
    tangent = placed.mesh->tangents[vertex];
  if (tangent == std::array<float, 3>{}) tangent = x_axis;
  return mapped(placed.to_world, tangent, 0);
}

void EmbreeScene::shading_tangents(Hits& hits) const {
  Vectors across{};
  const auto add = [](Vectors& to, int lane, const std::array<float, 3>& v, float weight) {
    to.x[lane] += weight * v[0];
    to.y[lane] += weight * v[1];
    to.z[lane] += weight * v[2];
  };
  for (int lane = 0; lane < lane_count; ++lane) {
    if (!hits.hit[lane]) continue;
    const Placed& placed = placed_[static_cast<std::size_t>(hits.object[lane])];
    add(across, lane, mapped(placed.to_world, z_axis, 0), 1);
    if (placed.mesh == nullptr) {
      add(hits.tangent, lane, corner_tangent(placed, 0), 1);
      continue;
    }
    const auto& triangle = placed.mesh->triangles[static_cast<std::size_t>(hits.primitive[lane])];
    const float u = hits.u[lane], v = hits.v[lane];
    add(hits.tangent, lane, corner_tangent(placed, triangle[0]), 1 - u - v);
    add(hits.tangent, lane, corner_tangent(placed, triangle[1]), u);
    add(hits.tangent, lane, corner_tangent(placed, triangle[2]), v);
  }
  hits.tangent = shared::steady_tangent(hits.normal, hits.tangent, across);
}

Corners EmbreeScene::corners(int object, int primitive) const {
  const Placed& placed = placed_[static_cast<std::size_t>(object)];
  const auto index = static_cast<std::size_t>(primitive);
  Corners corners{};
  corners.across = mapped(placed.to_world, z_axis, 0);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t vertex = placed.mesh->triangles[index][i];
    const Double3 at = placed.mesh->positions[vertex];
    Float3 position;
    for (std::size_t axis = 0; axis < 3; ++axis)
      position[axis] = static_cast<float>(at[axis] - placed.center[axis]);
    corners.position[i] = mapped(placed.to_world, position, 1);
    if (tangents_) corners.tangent[i] = corner_tangent(placed, vertex);
    if (placed.normals == nullptr) continue;
    const Float3& n = placed.normals[vertex];
    corners.normal[i] = n;
    if (!placed.instance) continue;
    for (std::size_t row = 0; row < 3; ++row) {
      const auto& r = placed.to_world_normals[row];
      corners.normal[i][row] = r[0] * n[0] + r[1] * n[1] + r[2] * n[2];
    }
  }
  return corners;
}

SurfaceUv EmbreeScene::surface_uv(int object, int primitive, float u, float v,
                                  const std::array<float, 3>& at) const {
  const Placed& placed = placed_[static_cast<std::size_t>(object)];
  if (placed.mesh == nullptr) {
    Eigen::Vector3f p(mapped(placed.from_world, at, 1).data());
    if (placed.plane)  // by metres
      return {p.x(), -p.z(), placed.uv_density};
    // By longitude and latitude; v goes over half a great circle.
    p.normalize();
    constexpr float pi = std::numbers::pi_v<float>;
    return {0.5f + std::atan2(p.x(), p.z()) / (2 * pi),
            0.5f + std::asin(std::clamp(p.y(), -1.0f, 1.0f)) / pi, placed.uv_density};
  }

  const auto [uv, place] =
      uv_triangle(*placed.mesh, static_cast<std::size_t>(primitive), corners(object, primitive));
  const Eigen::Vector2f here = (1 - u - v) * uv[0] + u * uv[1] + v * uv[2], ab = uv[1] - uv[0],
                        ac = uv[2] - uv[0];
  const float covered = std::abs(ab.x() * ac.y() - ab.y() * ac.x()),
              area = (place[1] - place[0]).cross(place[2] - place[0]).norm();
  return {here.x(), here.y(), area > 0 ? std::sqrt(covered / area) : 0};
}

SurfaceAxes EmbreeScene::surface_axes(int object, int primitive,
                                      const std::array<float, 3>& at) const {
  const Placed& placed = placed_[static_cast<std::size_t>(object)];
  const auto along = [&](const Float3& u, const Float3& v) {
    return SurfaceAxes{mapped(placed.to_world, u, 0), mapped(placed.to_world, v, 0),
                       placed.mirrored};
  };
  if (placed.plane) return along({1, 0, 0}, {0, 0, -1});
  if (placed.mesh == nullptr) {
    // d/du and d/dv of (cos φ sin θ, sin φ, cos φ cos θ), θ = 2π (u − ½), φ = π (v − ½).
    const Eigen::Vector3f p = Eigen::Vector3f(mapped(placed.from_world, at, 1).data()).normalized();
    const float ring = std::hypot(p.x(), p.z());  // cos φ; at the poles nothing has a direction
    if (!(ring > 1e-6f)) return {{}, {}, false};
    constexpr float pi = std::numbers::pi_v<float>;
    return along({2 * pi * p.z(), 0, -2 * pi * p.x()},
                 {-pi * p.y() * p.x() / ring, pi * ring, -pi * p.y() * p.z() / ring});
  }

  // P(u, v) over a triangle is linear.
  const auto [uv, place] =
      uv_triangle(*placed.mesh, static_cast<std::size_t>(primitive), corners(object, primitive));
  const Eigen::Vector2f ab = uv[1] - uv[0], ac = uv[2] - uv[0];
  const Eigen::Vector3f to_b = place[1] - place[0], to_c = place[2] - place[0];
  const float area = ab.x() * ac.y() - ab.y() * ac.x();
  if (!(std::abs(area) > 1e-6f * ab.norm() * ac.norm())) return {{}, {}, false};
  const Eigen::Vector3f u = (to_b * ac.y() - to_c * ab.y()) / area,
                        v = (to_c * ab.x() - to_b * ac.x()) / area;
  return {{u.x(), u.y(), u.z()}, {v.x(), v.y(), v.z()}, placed.mirrored};
}

}  // namespace metamer::cpu
