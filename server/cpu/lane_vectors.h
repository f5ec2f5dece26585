#pragma once

#include <Eigen/Core>

#include "server/cpu/lanes.h"

namespace metamer::cpu {

/// One of the vectors, for what is done by lane.
inline Eigen::Vector3f lane_of(const Vectors& v, unsigned lane) {
  return {v.x[lane], v.y[lane], v.z[lane]};
}
inline void set_lane(Vectors& v, const Eigen::Vector3f& to, unsigned lane) {
  v.x[lane] = to.x();
  v.y[lane] = to.y();
  v.z[lane] = to.z();
}

}  // namespace metamer::cpu
