#include "server/cpu/clear_shadows.h"

#include <cmath>
#include <limits>

#include "server/cpu/refraction.h"

namespace metamer::cpu {
namespace {

/// Clear surfaces that a light may shine through.
constexpr unsigned most_passed = 256;

/// Of what a ray towards a light has left behind.
class Way {
 public:
  Way(const Media& media, Packet& packet, Workspace& workspace)
      : media_(media), packet_(packet), workspace_(workspace) {}

  void absorb(unsigned lane, std::uint8_t medium, float distance) {
    const float strength = media_.strength(medium);
    if (!(strength > 0)) return;
    const float length = std::min(strength * distance, std::numeric_limits<float>::max());
    go_on(lane, {FactorKind::absorb, media_.material(medium), length});
  }

  void pass(unsigned lane, std::uint8_t from, std::uint8_t to, float cosine) {
    const Media::Interface* interface = from == to ? nullptr : media_.between(from, to);
    if (interface != nullptr) go_on(lane, {FactorKind::transmit, interface->number, cosine});
  }

 private:
  void go_on(unsigned lane, const Factor& factor) {
    packet_.chain[lane] =
        workspace_.gathers[packet_.pixel[lane]].chain_before(packet_.chain[lane], factor);
  }

  const Media& media_;
  Packet& packet_;
  Workspace& workspace_;
};

}  // namespace

void light_through(const Media& media, const EmbreeScene& geometry, const Vectors& to_light,
                   Floats reach, Packet& packet, Workspace& workspace) {
  Way way(media, packet, workspace);
  Packet at;
  at.direction = to_light;
  MediaStacks inside = *packet.inside;
  Vectors origin = packet.point, from = packet.hit;
  Ints left = packet.active, lit{};
  for (unsigned n = 0; n < most_passed && any(left); ++n) {
    workspace.add_rays(RayKind::shadow, left);
    Hits hits = geometry.intersect_others(origin, to_light, reach, left, {});
    for (unsigned i = 0; i < lane_count; ++i) {
      if (!left[i] || hits.hit[i]) continue;
      way.absorb(i, inside[i].top(), reach[i]);
      lit[i] = -1;
    }
    at.hit = origin + to_light * hits.distance;
    at.active = hits.hit;
    left = media.passable(at, hits);
    for (unsigned i = 0; i < lane_count; ++i)
      if (left[i] && media.is_clear(hits.object[i]) && !media.has_clear_shadow(hits.object[i]))
        left[i] = 0;
    if (!any(left)) break;

    // Go through what was met.
    const Vectors hit = at.hit;
    const Media::Crossing crossing = media.cross(at, hits, left, inside);
    left = crossing.passed & ~crossing.lost;
    packet.throughput *= 1.0f - crossing.layer;
    for (unsigned i = 0; i < lane_count; ++i) {
      if (!left[i]) continue;
      const float cosine = lane_of(to_light, i).dot(lane_of(hits.normal, i));
      way.absorb(i, inside[i].top(), (lane_of(hit, i) - lane_of(from, i)).norm());
      way.pass(i, inside[i].top(), crossing.inside[i].top(), std::clamp(-cosine, 0.0f, 1.0f));
      inside[i] = crossing.inside[i];
    }
    origin = select(left, crossing.beyond, origin);
    from = hit;
    reach = max(reach - hits.distance, Floats{});
  }
  packet.active = lit;
}

}  // namespace metamer::cpu
