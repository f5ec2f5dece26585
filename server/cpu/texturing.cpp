#include "server/cpu/texturing.h"

#include <algorithm>

#include "server/cpu/picture_spot.h"

namespace metamer::cpu {

Floats Texturing::divide(const Packet& packet, const Hits& hits, Workspace& workspace) const {
  Floats own = metamer::broadcast(1);
  workspace.texture_shares.clear();
  for (unsigned i = 0; i < lane_count; ++i) {
    if (!packet.active[i]) continue;
    const auto& material = scene_.materials[static_cast<std::size_t>(hits.material[i])];
    if (!material.texture) continue;
    const RenderTexture& texture = scene_.textures[*material.texture];
    const Weights weights = this->weights(texture, packet, hits, i);
    Gather& gather = workspace.gathers[packet.pixel[i]];
    float rest = 1;
    for (std::size_t c = 0; c < texture.materials.size(); ++c) {
      rest -= weights[c];
      if (weights[c] > 0)
        workspace.texture_shares.push_back(
            {i, gather.surface(packet.chain[i], texture.materials[c]), weights[c]});
    }
    own[i] = texture.has_ground ? std::max(rest, 0.0f) : 0;
  }
  return own;
}

std::optional<std::uint32_t> Texturing::choose(const Packet& packet, const Hits& hits,
                                               unsigned lane, float u) const {
  const auto own = static_cast<std::uint32_t>(hits.material[lane]);
  if (!scene_.materials[own].texture) return own;
  const RenderTexture& texture = scene_.textures[*scene_.materials[own].texture];
  const Weights weights = this->weights(texture, packet, hits, lane);
  for (std::size_t c = 0; c < texture.materials.size(); ++c)
    if ((u -= weights[c]) < 0) return texture.materials[c];
  if (texture.has_ground) return own;
  return {};
}

Texturing::Weights Texturing::weights(const RenderTexture& texture, const Packet& packet,
                                      const Hits& hits, unsigned lane) const {
  const PictureSpot at = picture_spot(geometry_, packet, hits, lane, footprint_);
  const PlacedPicture& placed = texture.placed;
  const auto [u, v] = placed.at(at.u, at.v);
  Weights weights{};
  add_weights(placed.picture, placed.wrap, u, v, placed.level(at.covered, at.slant),
              weights.data());
  return weights;
}

}  // namespace metamer::cpu
