#include "server/scene/light_parameters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "server/scene/placement.h"

namespace metamer {

lights::Values<double> light_parameters(const ChosenLight& light) {
  using Kind = lights::Parameter::Kind;
  lights::Values<double> values{};
  double* to = &values[1];
  for (const lights::Parameter& one : light.entry->parameters) {
    switch (one.kind) {
      case Kind::position: {
        const Eigen::Vector3d position = to_vector(light.vector(one));
        to = std::copy(position.begin(), position.end(), to);
        break;
      }
      case Kind::vector: {
        const Eigen::Vector3d vector = to_vector(light.vector(one));
        to = std::copy(vector.begin(), vector.end(), to);
        break;
      }
      case Kind::direction: {
        const Eigen::Vector3d direction = unit(to_vector(light.vector(one)));
        to = std::copy(direction.begin(), direction.end(), to);
        break;
      }
      case Kind::angle: {
        const double half_sine = std::sin(light.number(one) * std::numbers::pi / 360);
        *to++ = 2 * half_sine * half_sine;  // 1 − cos
        break;
      }
      case Kind::length:
      case Kind::number:
        *to++ = light.number(one);
        break;
    }
  }
  return values;
}

}  // namespace metamer
