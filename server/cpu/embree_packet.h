#pragma once

#include <embree3/rtcore.h>

#include "server/cpu/lanes.h"

/// Embree's packets: as many rays as there are lanes, or a group of them.
namespace metamer::cpu {

template <int lanes>
struct EmbreePacket;

template <>
struct EmbreePacket<8> {
  using Rays = RTCRay8;
  using RayHits = RTCRayHit8;
  static constexpr auto intersect = rtcIntersect8;
};

template <>
struct EmbreePacket<16> {
  using Rays = RTCRay16;
  using RayHits = RTCRayHit16;
  static constexpr auto intersect = rtcIntersect16;
};

using RayHits = EmbreePacket<lane_count>::RayHits;

}  // namespace metamer::cpu
