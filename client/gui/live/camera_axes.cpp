#include "client/gui/live/camera_axes.h"

#include <QVector3D>
#include <array>

namespace metamer::gui {
namespace {

QVector3D to_vector(const v1::Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

}  // namespace

std::optional<std::array<QPointF, 3>> camera_axes(const v1::Camera& camera) {
  const QVector3D forward = (to_vector(camera.target()) - to_vector(camera.eye())).normalized();
  const QVector3D given = camera.has_up() ? to_vector(camera.up()) : QVector3D(0, 1, 0);
  const QVector3D right = QVector3D::crossProduct(forward, given).normalized();
  if (forward.isNull() || right.isNull()) return std::nullopt;
  const QVector3D up = QVector3D::crossProduct(right, forward);
  std::array<QPointF, 3> axes;
  for (int i = 0; i < 3; ++i) axes[static_cast<std::size_t>(i)] = {right[i], -up[i]};
  return axes;
}

}  // namespace metamer::gui
