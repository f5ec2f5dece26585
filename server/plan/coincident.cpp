#include "server/plan/coincident.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "server/scene/placement.h"

namespace metamer {
namespace {

using Eigen::Vector3d;

/// What rounding to f32 does not tell apart.
constexpr double rounding = 1e-6;

/// A flat object.
struct Flat {
  std::size_t object;
  Vector3d normal;                ///< Unit; of the two that with its largest number positive.
  double distance;                ///< From the origin along it.
  std::vector<Vector3d> corners;  ///< Of a quad; none: a plane without end.

  double size() const {
    double largest = std::abs(distance);
    for (const Vector3d& corner : corners) largest = std::max(largest, corner.norm());
    return largest;
  }
};

std::optional<Flat> flat_of(const RenderScene& scene, std::size_t i) {
  const RenderObject& object = scene.objects[i];
  if (scene.materials[object.material].medium > 0) return std::nullopt;
  Flat flat{i, {}, 0, {}};
  Vector3d u = object.to_world.linear().col(2), v = object.to_world.linear().col(0);
  Vector3d point = object.to_world.translation();
  if (object.shape == RenderObject::Shape::mesh) {
    const TriangleMesh& mesh = scene.meshes[object.mesh];
    if (mesh.positions.size() != 4 || mesh.triangles.size() != 2) return std::nullopt;
    for (std::size_t k = 0; k < 4; ++k)
      flat.corners.push_back(object.to_world * to_vector(mesh.positions[k]));
    point = flat.corners[0];
    u = flat.corners[1] - point;
    v = flat.corners[2] - point;
  } else if (object.shape != RenderObject::Shape::plane) {
    return std::nullopt;
  }
  const Vector3d normal = u.normalized().cross(v.normalized());
  if (!(normal.norm() > rounding)) return std::nullopt;
  flat.normal = normal.normalized();
  Eigen::Index largest = 0;
  flat.normal.cwiseAbs().maxCoeff(&largest);
  if (flat.normal[largest] < 0) flat.normal = -flat.normal;
  flat.distance = flat.normal.dot(point);
  for (const Vector3d& corner : flat.corners)
    if (std::abs(flat.normal.dot(corner) - flat.distance) > rounding * flat.size())
      return std::nullopt;
  return flat;
}

/// Whether two sets of corners in one plane overlap by more than their edges: no line along a side
/// of either parts them.
bool overlap(const Flat& one, const Flat& other) {
  if (one.corners.empty() || other.corners.empty()) return true;
  for (const Flat* flat : {&one, &other})
    for (std::size_t i = 0; i < flat->corners.size(); ++i)
      for (std::size_t j = i + 1; j < flat->corners.size(); ++j) {
        const Vector3d axis = flat->normal.cross(flat->corners[j] - flat->corners[i]).normalized();
        std::array<std::pair<double, double>, 2> reach;
        for (const std::size_t k : {0U, 1U}) {
          reach[k] = {INFINITY, -INFINITY};
          for (const Vector3d& corner : (k == 0 ? one : other).corners) {
            reach[k].first = std::min(reach[k].first, axis.dot(corner));
            reach[k].second = std::max(reach[k].second, axis.dot(corner));
          }
        }
        const double shared =
            std::min(reach[0].second, reach[1].second) - std::max(reach[0].first, reach[1].first);
        if (!(shared > rounding * std::max(one.size(), other.size()))) return false;
      }
  return true;
}

bool in_one_plane(const Flat& one, const Flat& other) {
  return (one.normal - other.normal).norm() <= rounding &&
         std::abs(one.distance - other.distance) <= rounding * std::max(one.size(), other.size());
}

}  // namespace

void notice_coincident(const RenderScene& scene, v1::Plan& plan) {
  std::vector<Flat> flats;
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    if (auto flat = flat_of(scene, i)) flats.push_back(*std::move(flat));
  std::stable_sort(flats.begin(), flats.end(),
                   [](const Flat& a, const Flat& b) { return a.distance < b.distance; });

  // Look at neighbours alone: a wall of a thousand tiles is no work for a thousand squared.
  constexpr std::size_t neighbours = 64;
  std::size_t count = 0, first = 0, second = 0;
  for (std::size_t i = 0; i < flats.size(); ++i)
    for (std::size_t j = i + 1; j < std::min(flats.size(), i + neighbours); ++j) {
      if (!in_one_plane(flats[i], flats[j]) || !overlap(flats[i], flats[j])) continue;
      if (count++ > 0) continue;
      first = std::min(flats[i].object, flats[j].object);
      second = std::max(flats[i].object, flats[j].object);
    }
  if (count == 0) return;
  v1::Notice& notice = *plan.add_notice();
  notice.set_field("object[" + std::to_string(second) + "]");
  notice.set_message("it lies in the plane of object[" + std::to_string(first) +
                     "] and covers part of it: which of them is seen is up to rounding" +
                     (count > 1 ? " (and " + std::to_string(count - 1) + " more)" : ""));
}

}  // namespace metamer
