#pragma once

#include <cmath>
#include <numbers>

#include "server/cpu/lanes.h"

/// Directions around others.
namespace metamer::cpu::soft {

/// cos and sin of 2π v.
inline void turn(Floats v, Floats& cosine, Floats& sine) {
  for (int i = 0; i < lane_count; ++i) {
    const float angle = 2 * std::numbers::pi_v<float> * v[i];
    cosine[i] = std::cos(angle);
    sine[i] = std::sin(angle);
  }
}

/// Two unit vectors at right angles to a unit one, after T. Duff et al., "Building an Orthonormal
/// Basis, Revisited", JCGT 6(1), 2017.
inline void basis(const Vectors& n, Vectors& s, Vectors& t) {
  const Floats sign = select(n.z < 0.0f, broadcast(-1), broadcast(1));
  const Floats a = -1.0f / (sign + n.z), b = n.x * n.y * a;
  s = {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x};
  t = {b, sign + n.y * n.y * a, -n.y};
}

}  // namespace metamer::cpu::soft
