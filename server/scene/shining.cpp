#include "server/scene/shining.h"

#include "server/scene/placement.h"

namespace metamer {
namespace {

/// Of each triangle and those before it, as shares of the whole; empty: there is no area.
std::vector<double> shares_of_area(const RenderObject& object, const TriangleMesh& mesh) {
  const Eigen::Matrix3d map = object.to_world.linear();
  std::vector<double> up_to;
  up_to.reserve(mesh.triangles.size());
  double sum = 0;
  for (const Triangle& triangle : mesh.triangles) {
    const Eigen::Vector3d corner = to_vector(mesh.positions[triangle[0]]);
    const Eigen::Vector3d one = map * (to_vector(mesh.positions[triangle[1]]) - corner);
    const Eigen::Vector3d other = map * (to_vector(mesh.positions[triangle[2]]) - corner);
    up_to.push_back(sum += one.cross(other).norm());
  }
  if (!(sum > 0)) return {};
  for (double& share : up_to) share /= sum;
  return up_to;
}

}  // namespace

std::optional<Problem> find_shining(const std::vector<RenderLight>& lights, RenderScene& placed) {
  for (const RenderLight& light : lights) {
    if (light.source != RenderLight::Source::object) continue;
    RenderObject& object = placed.objects[light.object];
    if (object.shape != RenderObject::Shape::mesh || object.area_up_to) continue;
    auto shares = shares_of_area(object, placed.meshes[object.mesh]);
    if (shares.empty())
      return Problem{.field = light.field + ".object",
                     .file = {},
                     .message = "its object has no area that could shine"};
    object.area_up_to = std::make_shared<const std::vector<double>>(std::move(shares));
  }
  return {};
}

}  // namespace metamer
