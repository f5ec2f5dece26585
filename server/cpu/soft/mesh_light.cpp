#include <algorithm>
#include <cmath>
#include <numbers>

#include "server/cpu/soft/pointwise_light.h"
#include "server/scene/placement.h"

namespace metamer::cpu::soft {
namespace {

using Eigen::Vector3d;

/// sr. From farther away, points that are even in area are as good.
constexpr double least_near_triangle = 0.02;

/// The part of `x` at right angles to the unit vector `y`, unit.
Vector3d across(const Vector3d& x, const Vector3d& y) { return (x - x.dot(y) * y).normalized(); }

/// A triangle from a place: its corners' directions.
struct SeenTriangle {
  Vector3d a, b, c;

  /// A. van Oosterom and J. Strackee (1983).
  double solid_angle() const {
    return 2 * std::abs(std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a)));
  }
  /// Arvo's, of the area that solid_angle() has.
  Vector3d even_direction(double area, double u, double v) const {
    const double cos_alpha = std::clamp(across(b, a).dot(across(c, a)), -1.0, 1.0);
    const double alpha = std::acos(cos_alpha), sin_alpha = std::sin(alpha);
    const double s = std::sin(u * area - alpha), t = std::cos(u * area - alpha);
    const double p = t - cos_alpha, r = s + sin_alpha * a.dot(b);
    const double below = (r * s + p * t) * sin_alpha;
    const double q =
        below != 0 ? std::clamp(((r * t - p * s) * cos_alpha - r) / below, -1.0, 1.0) : 1;
    const Vector3d corner = q * a + std::sqrt(1 - q * q) * across(c, a);
    const double z = 1 - v * (1 - corner.dot(b));
    return z * b + std::sqrt(std::max(0.0, 1 - z * z)) * across(corner, b);
  }
};

class MeshLight : public PointwiseLight {
 public:
  MeshLight(const RenderObject& object, const TriangleMesh& mesh)
      : object_(object),
        mesh_(mesh),
        mirrored_(object.to_world.linear().determinant() < 0 ? -1 : 1) {}

  Found find(const Vector3d& at, double u, double v, int own) const override {
    // Choose a triangle by its area; what is left of u is a number of its own.
    const std::vector<double>& up_to = *object_.area_up_to;
    const auto found = std::upper_bound(up_to.begin(), up_to.end() - 1, u);
    const auto triangle = static_cast<std::size_t>(found - up_to.begin());
    const double before = triangle > 0 ? up_to[triangle - 1] : 0, share = *found - before;
    if (!(share > 0) || static_cast<int>(triangle) == own) return {};
    u = std::clamp((u - before) / share, 0.0, 1.0);

    const Triangle& corner = mesh_.triangles[triangle];
    const auto way = [&](std::size_t i) -> Vector3d {
      return object_.to_world * to_vector(mesh_.positions[corner[i]]) - at;
    };
    const Vector3d a = way(0), b = way(1), c = way(2), normal = (b - a).cross(c - a) * mirrored_;
    const double height = -normal.dot(a), twice_area = normal.norm();
    if (!(height > 0)) return {};  // from behind
    const SeenTriangle seen{a.normalized(), b.normalized(), c.normalized()};
    if (const double angle = seen.solid_angle(); angle > least_near_triangle) {
      const Vector3d direction = seen.even_direction(angle, u, v);
      return {direction, -height / normal.dot(direction), angle / (std::numbers::pi * share)};
    }
    const double root = std::sqrt(u);
    const Vector3d to = (1 - root) * a + root * ((1 - v) * b + v * c);
    const double squared = to.squaredNorm(), distance = std::sqrt(squared);
    const double cosine = height / (distance * twice_area);
    return {to / distance, distance,
            cosine * twice_area / (2 * std::numbers::pi * squared * share)};
  }

 private:
  const RenderObject& object_;
  const TriangleMesh& mesh_;
  double mirrored_;  ///< The sign by which corners turn in the world.
};

}  // namespace

std::shared_ptr<const PointwiseLight> make_mesh_light(const RenderObject& object,
                                                      const TriangleMesh& mesh) {
  return std::make_shared<MeshLight>(object, mesh);
}

}  // namespace metamer::cpu::soft
