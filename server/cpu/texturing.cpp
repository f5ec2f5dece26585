#include "server/cpu/texturing.h"

#include <algorithm>
#include <cmath>

namespace metamer::cpu {

Float8 Texturing::divide(const Packet& packet, const Hits& hits, Workspace& workspace) const {
  Float8 own = metamer::broadcast(1);
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
  const SurfaceUv at =
      geometry_.surface_uv(hits.object[lane], hits.primitive[lane], hits.u[lane], hits.v[lane],
                           {packet.hit.x[lane], packet.hit.y[lane], packet.hit.z[lane]});
  const auto& [row_u, row_v] = texture.map;
  const float u = row_u[0] * at.u + row_u[1] * at.v + row_u[2],
              v = row_v[0] * at.u + row_v[1] * at.v + row_v[2];

  // A sample covers a longer piece of a surface that it sees at a slant: the mean of both sides.
  constexpr float flattest = 1e-3f;
  const float cosine = std::abs(hits.geometric_normal.x[lane] * packet.direction.x[lane] +
                                hits.geometric_normal.y[lane] * packet.direction.y[lane] +
                                hits.geometric_normal.z[lane] * packet.direction.z[lane]);
  const float pixels = footprint_ * packet.travelled[lane] * at.density * texture.pixels_per_uv /
                       std::sqrt(std::max(cosine, flattest));
  Weights weights{};
  add_weights(texture.picture, texture.wrap, u, v, std::log2(pixels), weights.data());
  return weights;
}

}  // namespace metamer::cpu
