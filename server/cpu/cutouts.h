#pragma once

#include "server/cpu/embree_scene.h"
#include "server/cpu/packet.h"

namespace metamer::cpu {

/// Alpha: how much of a surface is there. Immutable, shared by threads.
class Cutouts {
 public:
  /// `footprint` as picture_spot() has it. The references must outlive it.
  Cutouts(const RenderScene& scene, const EmbreeScene& geometry, float footprint);

  /// Some material of the scene has an alpha.
  bool is_needed() const { return needed_; }

  /// 0 to 1 of what a lane has hit at packet.hit; 1 where its material has no alpha. By the length
  /// of its way: of 0 the finest pixels count.
  float share(const Packet& packet, const Hits& hits, unsigned lane) const;

 private:
  const RenderScene& scene_;
  const EmbreeScene& geometry_;
  float footprint_;
  bool needed_;
};

}  // namespace metamer::cpu
