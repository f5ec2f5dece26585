#pragma once

#include <QPointF>
#include <array>
#include <optional>

#include "metamer/v1/scene.pb.h"

namespace metamer::gui {

/// Where the scene's x, y and z point on the screen (right and down are positive), each at most 1
/// long, as seen from far away. Nothing: eye and target are one place, or the view is along `up`.
std::optional<std::array<QPointF, 3>> camera_axes(const v1::Camera& camera);

}  // namespace metamer::gui
