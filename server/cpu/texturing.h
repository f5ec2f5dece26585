#pragma once

#include <array>
#include <optional>

#include "common/scene/limits.h"
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
  Floats divide(const Packet& packet, const Hits& hits, Workspace& workspace) const;

  /// The material whose diffuse spectrum a lane has: its own, or with the probability of its share
  /// one of the texture's; `u` in [0, 1) says which. Nothing: the texture leaves it dark there.
  std::optional<std::uint32_t> choose(const Packet& packet, const Hits& hits, unsigned lane,
                                      float u) const;

 private:
  using Weights = std::array<float, limits::max_texture_spectra>;
  Weights weights(const RenderTexture& texture, const Packet& packet, const Hits& hits,
                  unsigned lane) const;

  const RenderScene& scene_;
  const EmbreeScene& geometry_;
  float footprint_;
};

}  // namespace metamer::cpu
