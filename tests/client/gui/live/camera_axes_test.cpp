#include "client/gui/live/camera_axes.h"

#include <gtest/gtest.h>

namespace metamer::gui {
namespace {

v1::Camera looking(double x, double y, double z) {
  v1::Camera camera;
  camera.mutable_eye()->set_x(-x);
  camera.mutable_eye()->set_y(-y);
  camera.mutable_eye()->set_z(-z);
  camera.mutable_target();
  return camera;
}

TEST(CameraAxes, PointRightAndUpForACameraThatLooksAlongMinusZ) {
  const auto axes = camera_axes(looking(0, 0, -1));
  ASSERT_TRUE(axes);
  EXPECT_NEAR((*axes)[0].x(), 1, 1e-6);
  EXPECT_NEAR((*axes)[1].y(), -1, 1e-6);  // up on a screen is negative
  EXPECT_NEAR((*axes)[2].manhattanLength(), 0, 1e-6);
}

TEST(CameraAxes, AreNoneWhereTheViewIsAlongUpOrHasNoLength) {
  EXPECT_FALSE(camera_axes(looking(0, -1, 0)));
  EXPECT_FALSE(camera_axes(looking(0, 0, 0)));
}

}  // namespace
}  // namespace metamer::gui
