#pragma once

#include "server/cpu/embree_scene.h"
#include "server/cpu/packet.h"

namespace metamer::cpu {

/// Divides diffuse light among the spectra of textures. Immutable, shared by threads.
class Texturing {
 public:
  /// `footprint`: the side of a sample's square, seen from a distance of 1. The references must
  /// outlive it.
  Texturing(const RenderScene& scene, const EmbreeScene& geometry, float footprint)
      : scene_(scene), geometry_(geometry), footprint_(footprint) {}

  /// Some material of the scene has a texture.
  bool is_needed() const { return !scene_.textures.empty(); }

  /// What of each lane's diffuse light is its material's own, 1 where it has no texture; the rest
  /// is in workspace.texture_shares then.
  Float8 divide(const Packet& packet, const Hits& hits, Workspace& workspace) const;

 private:
  const RenderScene& scene_;
  const EmbreeScene& geometry_;
  float footprint_;
};

}  // namespace metamer::cpu
