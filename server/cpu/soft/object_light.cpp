#include "server/cpu/soft/object_light.h"

#include <algorithm>
#include <optional>

#include "server/cpu/soft/pointwise_light.h"
#include "server/scene/placement.h"

namespace metamer::cpu::soft {
namespace {

using Eigen::Vector3d;

/// A light of this shape in its place: numbers as `quad` and `sphere` of lights.def have them.
RenderLight shaped(lights::Light shape, std::initializer_list<Vector3d> vectors) {
  RenderLight light{};
  light.light = shape;
  std::size_t at = 1;
  for (const Vector3d& vector : vectors)
    for (const double number : vector) light.parameters[at++] = number;
  return light;
}

/// Two triangles around a corner that they share, whose fourth corner is opposite to it.
std::optional<RenderLight> as_quad(const RenderObject& object, const TriangleMesh& mesh) {
  if (mesh.triangles.size() != 2) return {};
  const Triangle &one = mesh.triangles[0], &other = mesh.triangles[1];
  if (one[0] != other[0] || one[2] != other[1]) return {};
  const auto at = [&](std::uint32_t vertex) { return to_vector(mesh.positions[vertex]); };
  const Vector3d corner = at(one[0]), u = at(one[1]) - corner, v = at(other[2]) - corner;
  const double off = (corner + u + v - at(one[2])).norm();
  if (!(off <= 1e-6 * (u.norm() + v.norm()))) return {};
  const Eigen::Matrix3d map = object.to_world.linear();
  const Vector3d to_u = map * u, to_v = map * v, place = object.to_world * corner;
  // A mirrored one shines to the same side of its own.
  return map.determinant() < 0 ? shaped(lights::Light::quad, {place, to_v, to_u})
                               : shaped(lights::Light::quad, {place, to_u, to_v});
}

/// Where its map scales all directions alike.
std::optional<RenderLight> as_sphere(const Eigen::Affine3d& map) {
  const double radius = map.linear().col(0).norm();
  const Eigen::Matrix3d turned = map.linear() / radius;
  const Eigen::Matrix3d off = turned.transpose() * turned - Eigen::Matrix3d::Identity();
  if (!(off.cwiseAbs().maxCoeff() <= 1e-6)) return {};
  RenderLight light = shaped(lights::Light::sphere, {map.translation()});
  light.parameters[4] = radius;
  return light;
}

}  // namespace

SurfaceLight object_light(const RenderScene& scene, const RenderLight& light) {
  const RenderObject& object = scene.objects[light.object];
  if (object.shape == RenderObject::Shape::sphere) {
    if (const auto sphere = as_sphere(object.to_world)) return SurfaceLight(*sphere);
    return SurfaceLight(make_ellipsoid_light(object.to_world));
  }
  const TriangleMesh& mesh = scene.meshes[object.mesh];
  if (const auto quad = as_quad(object, mesh)) return SurfaceLight(*quad);
  return SurfaceLight(make_mesh_light(object, mesh));
}

}  // namespace metamer::cpu::soft
