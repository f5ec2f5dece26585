#include "server/cpu/cutouts.h"

#include "server/cpu/picture_spot.h"

namespace metamer::cpu {

Cutouts::Cutouts(const RenderScene& scene, const EmbreeScene& geometry, float footprint)
    : scene_(scene), geometry_(geometry), footprint_(footprint), needed_(scene.has_alpha()) {}

float Cutouts::share(const Packet& packet, const Hits& hits, unsigned lane) const {
  const auto& alpha = scene_.materials[static_cast<std::size_t>(hits.material[lane])].alpha;
  if (!alpha) return 1;
  const RenderMap& map = scene_.maps[*alpha];
  const PictureSpot spot = picture_spot(geometry_, packet, hits, lane, footprint_);
  return alpha_at(map, spot.u, spot.v, map.placed.level(spot.covered, spot.slant));
}

}  // namespace metamer::cpu
