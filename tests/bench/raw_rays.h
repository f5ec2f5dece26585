#pragma once

#include <cstdint>
#include <vector>

#include "metamer/v1/plan.pb.h"
#include "server/cpu/embree_scene.h"

namespace metamer::bench {

/// The camera and shadow rays of a picture without mirrors, in packets of eight, made by plain
/// scalar code: what Embree alone takes for them is the tracer's upper bound.
class RawRays {
 public:
  RawRays(const RenderScene& scene, const cpu::EmbreeScene& geometry, const v1::Plan& plan);

  std::uint64_t count() const { return count_; }

  /// Issues all of them with the coherent flag, camera and shadow packets in the tracer's order.
  void replay(RTCScene scene) const;

 private:
  struct Packet {
    alignas(32) int valid[8];
    bool shadow;
    RTCRay8 ray;
  };
  std::vector<Packet> packets_;
  std::uint64_t count_ = 0;
};

}  // namespace metamer::bench
