#pragma once

#include "server/cpu/embree_scene.h"
#include "server/cpu/packet.h"

namespace metamer::cpu {

/// Turns shading normals by the normal and bump maps of materials. Immutable, shared by threads.
class NormalMaps {
 public:
  /// `footprint` as picture_spot() has it. The references must outlive it.
  NormalMaps(const RenderScene& scene, const EmbreeScene& geometry, float footprint);

  bool is_needed() const { return needed_; }

  /// Those of the packet's active lanes, which have hit at packet.hit. Tangent space is that of the
  /// picture: x along its rising u, y across that towards rising v, z the shading normal outwards.
  /// Heights turn it by their gradient along the surface (J. F. Blinn, Simulation of Wrinkled
  /// Surfaces, SIGGRAPH 1978), taken between places that are a pixel apart. What would point below
  /// the surface is brought above it; where UVs have no direction the normal stays.
  void turn(const Packet& packet, Hits& hits) const;

 private:
  const RenderScene& scene_;
  const EmbreeScene& geometry_;
  float footprint_;
  bool needed_ = false;
};

}  // namespace metamer::cpu
