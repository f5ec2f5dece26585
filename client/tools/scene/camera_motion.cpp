#include "client/tools/scene/camera_motion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace metamer::client {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double default_fov = 35;  ///< Degrees, as scene.proto says.

Eigen::Vector3d to_eigen(const v1::Vec3& v) { return {v.x(), v.y(), v.z()}; }

void set(const Eigen::Vector3d& from, v1::Vec3& to) {
  to.set_x(from.x());
  to.set_y(from.y());
  to.set_z(from.z());
}

Eigen::Vector3d up_of(const v1::Camera& camera) {
  return camera.has_up() ? to_eigen(camera.up()) : Eigen::Vector3d::UnitY();
}

/// From the target to the eye.
Eigen::Vector3d arm_of(const v1::Camera& camera) {
  return to_eigen(camera.eye()) - to_eigen(camera.target());
}

v1::Camera with_arm(const v1::Camera& camera, const Eigen::Vector3d& arm) {
  v1::Camera result = camera;
  set(to_eigen(camera.target()) + arm, *result.mutable_eye());
  return result;
}

}  // namespace

v1::Camera orbit(const v1::Camera& camera, double degrees) {
  const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180, up_of(camera).normalized());
  return with_arm(camera, turn * arm_of(camera));
}

v1::Camera elevate(const v1::Camera& camera, double degrees) {
  const Eigen::Vector3d up = up_of(camera).stableNormalized(), arm = arm_of(camera);
  const Eigen::Vector3d across = up.cross(arm);
  const double from_up = std::atan2(across.stableNorm(), up.dot(arm)) / degree;
  // How far it may go either way; nowhere beyond what it has passed already.
  const double most = std::max(0.0, from_up - closest_to_up);
  const double least = std::min(0.0, from_up - (180 - closest_to_up));
  const double angle = std::clamp(degrees, least, most) * degree;
  return with_arm(camera, Eigen::AngleAxisd(-angle, across.stableNormalized()) * arm);
}

v1::Camera pan(const v1::Camera& camera, double right, double up) {
  const Eigen::Vector3d arm = arm_of(camera);
  const Eigen::Vector3d to_right = up_of(camera).cross(arm).stableNormalized();
  const Eigen::Vector3d to_up = arm.cross(to_right).stableNormalized();
  const double fov = camera.has_vertical_fov() ? camera.vertical_fov() : default_fov;
  const double height = 2 * arm.stableNorm() * std::tan(fov * degree / 2);
  const Eigen::Vector3d step = height * (right * to_right + up * to_up);
  v1::Camera result = camera;
  set(to_eigen(camera.eye()) + step, *result.mutable_eye());
  set(to_eigen(camera.target()) + step, *result.mutable_target());
  return result;
}

v1::Camera dolly(const v1::Camera& camera, double factor) {
  return with_arm(camera, factor * arm_of(camera));
}

}  // namespace metamer::client
