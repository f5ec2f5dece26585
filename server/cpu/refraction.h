#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "server/cpu/lane_vectors.h"

namespace metamer::cpu {

/// Reflected about the shading normal, or the surface's own where that would lead below it. Unit.
inline Eigen::Vector3f reflect(const Eigen::Vector3f& direction, const Eigen::Vector3f& normal,
                               const Eigen::Vector3f& surface) {
  const auto about = [&](const Eigen::Vector3f& n) -> Eigen::Vector3f {
    return direction - n * (2 * direction.dot(n));
  };
  const Eigen::Vector3f smooth = about(normal);
  return (smooth.dot(surface) > 0 ? smooth : about(surface)).normalized();
}

/// What becomes of a ray where it meets another medium.
struct Refraction {
  Eigen::Vector3f reflected, transmitted;  ///< Unit.
  float cosine_from, cosine_to;            ///< Of the angles to the normal, 0..1.
  float fresnel;                           ///< F for this ratio of indices; E[2.2-9].
  bool is_total;                           ///< Nothing goes on: `transmitted` is not set.
};

/// By Snell's law; `ratio` is n on the ray's side by n beyond. Normals are unit and on the ray's
/// side; the surface's own takes the shading normal's place where that would lead above it.
inline Refraction refract(const Eigen::Vector3f& direction, const Eigen::Vector3f& normal,
                          const Eigen::Vector3f& surface, float ratio) {
  Refraction bent{};
  bent.reflected = reflect(direction, normal, surface);
  const auto by = [&](const Eigen::Vector3f& n) {
    bent.cosine_from = std::clamp(-direction.dot(n), 0.0f, 1.0f);
    // 1 − ratio² sin², whose difference vanishes at the critical angle.
    const float sine = std::sqrt((1 - bent.cosine_from) * (1 + bent.cosine_from));
    const float squared = (1 - ratio * sine) * (1 + ratio * sine);
    bent.is_total = !(squared > 0);
    bent.cosine_to = std::sqrt(std::max(squared, 0.0f));
    bent.transmitted =
        (direction * ratio + n * (ratio * bent.cosine_from - bent.cosine_to)).normalized();
  };
  by(normal);
  if (!bent.is_total && !(bent.transmitted.dot(surface) < 0)) by(surface);
  const float from = bent.cosine_from, to = bent.cosine_to;
  const float across = (ratio * from - to) / std::max(ratio * from + to, 1e-30f);
  const float along = (from - ratio * to) / std::max(from + ratio * to, 1e-30f);
  bent.fresnel = bent.is_total ? 1 : std::min((across * across + along * along) / 2, 1.0f);
  return bent;
}

}  // namespace metamer::cpu
