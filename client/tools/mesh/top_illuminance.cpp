#include "client/tools/mesh/top_illuminance.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/mesh/vertex.h"

namespace metamer::client {
namespace {

using Eigen::Vector3d;
constexpr double share = 0.999;
constexpr std::size_t places = 1u << 16;  ///< 65 of them are brighter than that share.

Vector3d to_vector(const Double3& v) { return {v[0], v[1], v[2]}; }

/// Where its light comes from, from a place; unit. 0: the place is the light's.
Vector3d toward(const GltfLight& light, const Vector3d& place) {
  if (light.kind == GltfLight::Kind::directional) return -to_vector(light.direction);
  return (to_vector(light.position) - place).normalized();
}

/// Whether a place is in the light's cone, if it has one; `from`: where its light comes from.
bool shines_along(const GltfLight& light, const Vector3d& from) {
  return light.kind != GltfLight::Kind::spot ||
         -from.dot(to_vector(light.direction)) >=
             std::cos(light.outer_cone * std::numbers::pi / 180);
}

/// The brighter side of a surface.
double brighter_side(const std::vector<GltfLight>& lights, const Vector3d& place,
                     const Vector3d& normal, double nearest) {
  double front = 0, back = 0;
  for (const GltfLight& light : lights) {
    const Vector3d from = toward(light, place);
    if (!shines_along(light, from)) continue;
    const double cosine = normal.dot(from);
    const double e = illuminance_at(light, {place.x(), place.y(), place.z()}, nearest);
    (cosine > 0 ? front : back) += e * std::abs(cosine);
  }
  return std::max(front, back);
}

struct Corners {
  Vector3d a, b, c;
  Vector3d cross() const { return (b - a).cross(c - a); }
};

Corners corners_of_triangle(const MeshFile& mesh, const Triangle& t) {
  return {to_vector(position(mesh, t[0])), to_vector(position(mesh, t[1])),
          to_vector(position(mesh, t[2]))};
}

}  // namespace

double illuminance_at(const GltfLight& light, const Double3& place, double nearest) {
  if (light.kind == GltfLight::Kind::directional) return light.intensity;
  const double away = std::max((to_vector(place) - to_vector(light.position)).norm(), nearest);
  return light.intensity / (away * away);
}

double top_illuminance(const MeshFile& mesh, const std::vector<GltfLight>& lights) {
  double area = 0;
  for (const Triangle& t : mesh.triangles) area += corners_of_triangle(mesh, t).cross().norm();
  if (!(area > 0) || lights.empty()) return 0;

  // As many places in each triangle as its share of the area, by Roberts' R2 sequence.
  constexpr double plastic = 1.324717957244746;
  const double nearest = 1e-6 * std::sqrt(area);
  std::vector<double> brightness;
  double before = 0;
  for (const Triangle& t : mesh.triangles) {
    const Corners corners = corners_of_triangle(mesh, t);
    const Vector3d cross = corners.cross();
    before += cross.norm();
    while (brightness.size() < places &&
           (static_cast<double>(brightness.size()) + 0.5) * area < before * places) {
      const auto i = static_cast<double>(brightness.size());
      double u = std::fmod(0.5 + i / plastic, 1), v = std::fmod(0.5 + i / (plastic * plastic), 1);
      if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
      }
      const Vector3d place = corners.a + u * (corners.b - corners.a) + v * (corners.c - corners.a);
      brightness.push_back(brighter_side(lights, place, cross.normalized(), nearest));
    }
  }
  if (brightness.empty()) return 0;
  const auto top = brightness.begin() +
                   static_cast<std::ptrdiff_t>(share * static_cast<double>(brightness.size() - 1));
  std::nth_element(brightness.begin(), top, brightness.end());
  return *top;
}

}  // namespace metamer::client
