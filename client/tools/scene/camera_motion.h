#pragma once

#include "metamer/v1/scene.pb.h"

/// A camera moved by hand. What is left out of a camera has scene.proto's defaults. Distances are
/// finite, eye and target apart, and the view not along `up`, as validate_scene demands.
namespace metamer::client {

/// The eye turned around the target about the camera's own up, counter-clockwise as seen from
/// above. Degrees.
v1::Camera orbit(const v1::Camera& camera, double degrees);

/// The eye raised around the target, above 0 towards the camera's up. Stops where the view would
/// come nearer to up or down than closest_to_up, and does not move at all where it is nearer.
/// Degrees.
v1::Camera elevate(const v1::Camera& camera, double degrees);
inline constexpr double closest_to_up = 1;  ///< Degrees.

/// Eye and target moved alike, across the view. 1 is the height of what is seen at the target's
/// distance, so that a picture dragged by its own height goes out of sight. `right` and `up` are
/// the camera's way: the scene goes the other one.
v1::Camera pan(const v1::Camera& camera, double right, double up);

/// The eye's distance from the target times `factor`, which is finite and above 0.
v1::Camera dolly(const v1::Camera& camera, double factor);

}  // namespace metamer::client
