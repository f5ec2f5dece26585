#include <cmath>
#include <numbers>

#include "server/cpu/soft/pointwise_light.h"

namespace metamer::cpu::soft {
namespace {

using Eigen::Vector3d;

class EllipsoidLight : public PointwiseLight {
 public:
  explicit EllipsoidLight(const Eigen::Affine3d& to_world)
      : to_world_(to_world), from_world_(to_world.inverse()) {}

  Found find(const Vector3d& at, double u, double v, int) const override {
    const Vector3d from = from_world_ * at;
    const double squared = from.squaredNorm();
    if (!(squared > 1)) return {};
    // In the cone that the unit sphere fills, without losing the digits of a small one.
    const double cone = 1 / squared / (1 + std::sqrt(1 - 1 / squared));
    const double versine = u * cone, sine_squared = versine * (2 - versine);
    const double across = std::sqrt(sine_squared), turn = 2 * std::numbers::pi * v;
    const Vector3d axis = -from / std::sqrt(squared), side = axis.unitOrthogonal();
    const Vector3d direction = (1 - versine) * axis + across * std::cos(turn) * side +
                               across * std::sin(turn) * axis.cross(side);
    const double reach =
        std::sqrt(squared) * (1 - versine) - std::sqrt(std::max(0.0, 1 - squared * sine_squared));

    const Vector3d to = to_world_.linear() * direction;
    const double length = to.norm();
    const double stretched =
        std::abs(to_world_.linear().determinant()) / (length * length * length);
    return {to / length, reach * length, 2 * cone * stretched};  // Ω / π, Ω = 2π (1 − cos)
  }

 private:
  Eigen::Affine3d to_world_, from_world_;
};

}  // namespace

std::shared_ptr<const PointwiseLight> make_ellipsoid_light(const Eigen::Affine3d& to_world) {
  return std::make_shared<EllipsoidLight>(to_world);
}

}  // namespace metamer::cpu::soft
