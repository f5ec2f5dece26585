// A camera moved by hand, against closed forms.
#include "client/tools/scene/camera_motion.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace metamer::client {
namespace {

using Vector3 = Eigen::Vector3d;

Vector3 vector_of(const v1::Vec3& v) { return {v.x(), v.y(), v.z()}; }

void set(v1::Vec3& v, double x, double y, double z) {
  v.set_x(x);
  v.set_y(y);
  v.set_z(z);
}

v1::Camera camera_at(const Vector3& eye, const Vector3& target = Vector3::Zero()) {
  v1::Camera camera;
  set(*camera.mutable_eye(), eye.x(), eye.y(), eye.z());
  set(*camera.mutable_target(), target.x(), target.y(), target.z());
  return camera;
}

void expect_eye(const v1::Camera& camera, const Vector3& eye, double within = 1e-12) {
  EXPECT_LE((vector_of(camera.eye()) - eye).stableNorm(), within)
      << vector_of(camera.eye()).transpose() << ", not " << eye.transpose();
}

TEST(CameraMotion, AQuarterOrbitGoesToTheRight) {
  expect_eye(orbit(camera_at({0, 1, 4}), 90), {4, 1, 0});
  expect_eye(orbit(camera_at({0, 1, 4}), -90), {-4, 1, 0});
  expect_eye(orbit(camera_at({5, 1, 4}, {5, 0, 0}), 180), {5, 1, -4});
}

TEST(CameraMotion, OrbitTurnsAboutTheCamerasOwnUp) {
  v1::Camera camera = camera_at({4, 0, 0});
  set(*camera.mutable_up(), 0, 0, 1e-3);
  expect_eye(orbit(camera, 90), {0, 4, 0});
  EXPECT_EQ(orbit(camera, 90).up().z(), 1e-3);
}

TEST(CameraMotion, OrbitsAddUpAndKeepTheDistance) {
  v1::Camera camera = camera_at({0.3, 1.7, -2.9}, {0.1, 0.2, 0.3});
  const double distance = (vector_of(camera.eye()) - vector_of(camera.target())).norm();
  v1::Camera moved = camera;
  for (int i = 0; i < 360; ++i) moved = orbit(moved, 1);
  expect_eye(moved, vector_of(camera.eye()));
  moved = elevate(orbit(camera, 77), 23);
  EXPECT_NEAR((vector_of(moved.eye()) - vector_of(moved.target())).norm(), distance, 1e-14);
}

TEST(CameraMotion, ElevationIsAnAngleAboveTheHorizon) {
  const double s = std::sqrt(0.5);
  expect_eye(elevate(camera_at({0, 0, 2}), 45), {0, 2 * s, 2 * s});
  expect_eye(elevate(camera_at({3, 0, 0}), -30), {3 * std::cos(std::numbers::pi / 6), -1.5, 0});
}

TEST(CameraMotion, ElevationStopsBesideTheZenith) {
  const double left = closest_to_up * std::numbers::pi / 180;
  expect_eye(elevate(camera_at({0, 0, 1}), 1e9), {0, std::cos(left), std::sin(left)});
  expect_eye(elevate(camera_at({0, 0, 1}), -90), {0, -std::cos(left), std::sin(left)});
  // Nearer than that already: it can come back, and goes no nearer.
  const v1::Camera near = camera_at({0, 1, 0.001});
  expect_eye(elevate(near, 5), vector_of(near.eye()), 0);
  EXPECT_LT(elevate(near, -30).eye().y(), 0.9);
}

TEST(CameraMotion, APanByOneMovesByTheHeightThatIsSeen) {
  v1::Camera camera = camera_at({0, 0, 2});
  camera.set_vertical_fov(90);
  const v1::Camera moved = pan(camera, 0.5, -1);
  expect_eye(moved, {2, -4, 2});
  EXPECT_NEAR(moved.target().x(), 2, 1e-14);
  EXPECT_NEAR(moved.target().y(), -4, 1e-14);
  // 35 degrees when left out.
  camera.clear_vertical_fov();
  EXPECT_NEAR(pan(camera, 1, 0).eye().x(), 4 * std::tan(17.5 * std::numbers::pi / 180), 1e-14);
}

TEST(CameraMotion, APanKeepsTheView) {
  const v1::Camera camera = camera_at({3, 4, 5}, {1, 1, 1});
  const v1::Camera moved = pan(camera, 0.3, 0.7);
  const Vector3 before = vector_of(camera.target()) - vector_of(camera.eye());
  const Vector3 after = vector_of(moved.target()) - vector_of(moved.eye());
  EXPECT_LE((after - before).norm(), 1e-14);
  EXPECT_NEAR((vector_of(moved.eye()) - vector_of(camera.eye())).dot(before), 0, 1e-13);
}

TEST(CameraMotion, ADollyChangesTheDistanceAlone) {
  expect_eye(dolly(camera_at({1, 2, 5}, {1, 2, 1}), 0.25), {1, 2, 2});
  const v1::Camera far = dolly(dolly(camera_at({1, 2, 5}), 1e9), 1e-9);
  expect_eye(far, {1, 2, 5});
}

TEST(CameraMotion, ScenesMayBeTinyOrVast) {
  for (const double size : {1e-200, 1e15}) {
    const v1::Camera camera = camera_at({0, 0, size});
    expect_eye(elevate(camera, 30), {0, size / 2, size * std::sqrt(0.75)}, size * 1e-14);
    EXPECT_NEAR(pan(camera, 1, 0).eye().x() / size, 2 * std::tan(17.5 * std::numbers::pi / 180),
                1e-14);
  }
}

}  // namespace
}  // namespace metamer::client
