#include "server/scene/surface_white.h"

#include <array>
#include <cmath>
#include <numbers>

namespace metamer {
namespace {

using Eigen::Vector3d;

Vector3d vector_at(const RenderLight& light, std::size_t at) {
  return {light.parameters[at], light.parameters[at + 1], light.parameters[at + 2]};
}

/// Of a disk's or a sphere's radius.
double squared(double ratio) { return ratio * ratio; }

/// J. H. Lambert, Photometria (1760): E of a polygon is L/2 times the sum over its edges of the
/// angle that an edge is seen under times the cosine between the white's normal and that of the
/// plane through the edge and the white.
double white_before_quad(const Vector3d& u, const Vector3d& v, double distance) {
  const Vector3d normal = u.cross(v).normalized();
  const std::array<Vector3d, 4> corners = {-u / 2 - v / 2, u / 2 - v / 2, u / 2 + v / 2,
                                           -u / 2 + v / 2};
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d from = corners[i] - distance * normal;
    const Vector3d to = corners[(i + 1) % 4] - distance * normal;
    const Vector3d edge = from.cross(to);
    sum += std::atan2(edge.norm(), from.dot(to)) * edge.normalized().dot(normal);
  }
  return std::abs(sum) / (2 * std::numbers::pi);
}

}  // namespace

double white_before(const RenderLight& light, double distance) {
  switch (light.light) {
    case lights::Light::quad:
      return white_before_quad(vector_at(light, 4), vector_at(light, 7), distance);
    case lights::Light::disk:
      return squared(light.parameters[7] / std::hypot(light.parameters[7], distance));
    default:
      return squared(light.parameters[4] / distance);
  }
}

}  // namespace metamer
