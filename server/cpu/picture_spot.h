#pragma once

#include <algorithm>
#include <cmath>

#include "server/cpu/embree_scene.h"
#include "server/cpu/packet.h"

namespace metamer::cpu {

/// Where a sample looks at the pictures of a surface.
struct PictureSpot {
  float u, v;     ///< Of the surface.
  float covered;  ///< Of its UV, along one side, if it were seen head on.
  float slant;    ///< By what that is to be divided.
};

/// Of a lane at packet.hit, by the length of its way; `footprint`: the side of a sample's square,
/// seen from a distance of 1. The object has UVs.
inline PictureSpot picture_spot(const EmbreeScene& geometry, const Packet& packet, const Hits& hits,
                                unsigned lane, float footprint) {
  const unsigned i = lane;
  const SurfaceUv at = geometry.surface_uv(hits.object[i], hits.primitive[i], hits.u[i], hits.v[i],
                                           {packet.hit.x[i], packet.hit.y[i], packet.hit.z[i]});
  // A sample covers a longer piece of a surface that it sees at a slant: the mean of both sides.
  constexpr float flattest = 1e-3f;
  const float cosine = std::abs(hits.geometric_normal.x[i] * packet.direction.x[i] +
                                hits.geometric_normal.y[i] * packet.direction.y[i] +
                                hits.geometric_normal.z[i] * packet.direction.z[i]);
  return {at.u, at.v, footprint * packet.travelled[i] * at.density,
          std::sqrt(std::max(cosine, flattest))};
}

}  // namespace metamer::cpu
