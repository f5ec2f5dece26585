#pragma once

#include <cstdint>
#include <vector>

#include "metamer/v1/plan.pb.h"
#include "server/cpu/embree_scene.h"

namespace metamer::bench {

/// The camera and shadow rays of a picture without mirrors, in packets as the tracer has them, made
/// by plain scalar code: what Embree alone takes for them is the tracer's upper bound.
template <int lanes>
class RawRays {
 public:
  /// Of at least eight samples a pixel.
  RawRays(const RenderScene& scene, const cpu::EmbreeScene& geometry, const v1::Plan& plan);

  std::uint64_t count() const { return count_; }

  /// Issues all of them with the tracer's flags, camera and shadow packets in its order.
  void replay(RTCScene scene) const;

 private:
  using Embree = cpu::EmbreePacket<lanes>;
  /// Of camera rays; shadow rays are in packets of a group each.
  template <int size, class Rays>
  struct PacketOf {
    alignas(4 * size) int valid[size]{};
    Rays ray{};
    std::size_t shadows = 0;  ///< So many packets of them are issued before it.
  };
  using Packet = PacketOf<lanes, typename Embree::Rays>;
  using Shadows = PacketOf<group_size, RTCRay8>;

  template <class To>
  void set(To& packet, int lane, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
           float length);
  void add_shadows(const RenderScene& scene, const cpu::EmbreeScene& geometry,
                   const Packet& camera);

  std::vector<Packet> packets_;
  std::vector<Shadows> shadows_;
  std::uint64_t count_ = 0;
};

}  // namespace metamer::bench
