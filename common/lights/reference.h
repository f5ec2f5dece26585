#pragma once

#include <Eigen/Core>

#include "common/lights/registry.h"

/// The lights in f64 for one point: what tests trust. The same sources as the renderers', in
/// another number type.
namespace metamer::lights {

/// What a light sends to a point; shaders/lights/incident.glsl.
struct Incident {
  Eigen::Vector3d direction;  ///< To the light, unit.
  double reach;               ///< Of a shadow ray.
  double weight;              ///< Of the light's luminance.
};

Incident incident(Light light, const Values<double>& values, const Eigen::Vector3d& at);

}  // namespace metamer::lights
