#include "server/gl/camera.h"

namespace metamer::gl {
namespace {

std::array<float, 3> to_array(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

std::array<float, 4> row(const Eigen::Vector4d& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]),
          static_cast<float>(v[3])};
}

Eigen::Vector4d extend(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z(), 0}; }

}  // namespace

void RegionView::set(const Program& program, SamplePoint place) const {
  const double pixel = 2 * camera.tan_half_fov / height;
  program.set("across", to_array(camera.right * pixel));
  program.set("down", to_array(-camera.up * pixel));
  program.set("corner", to_array(camera.forward - camera.right * (pixel * width / 2) +
                                 camera.up * (pixel * height / 2)));
  program.set("forward", to_array(camera.forward));
  program.set("eye", to_array(camera.eye));
  program.set("region", std::array{region.x, region.y});
  program.set("region_size", std::array{region.width, region.height});
  program.set("place", std::array{place.x, place.y});

  // Of a point from the eye: a sample is seen in the middle of its pixel; rows count downwards, as
  // in the film.
  const Eigen::Vector4d w = extend(camera.forward);
  const double left = width / 2.0 - region.x - double{place.x} + 0.5;
  const double top = height / 2.0 - region.y - double{place.y} + 0.5;
  const Eigen::Vector4d across = extend(camera.right) / pixel + left * w;
  const Eigen::Vector4d downwards = -extend(camera.up) / pixel + top * w;
  program.set("to_clip", {row(2.0 / region.width * across - w),
                          row(2.0 / region.height * downwards - w), row(w)});
}

}  // namespace metamer::gl
