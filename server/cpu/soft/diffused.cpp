// How a Shading looks for the light that other surfaces reflect: along rays that it scatters.

#include "server/cpu/shading.h"
#include "server/cpu/shared_source.h"
#include "server/cpu/soft/around.h"

namespace metamer::cpu {
namespace {

/// Numbers of what a path chooses, beside those of lights.
constexpr std::uint32_t of_direction = 1U << 31, of_spectrum = of_direction + 1;

/// Unit vectors whose density is the cosine of their angle to the normal by π (Malley's method).
Vectors by_cosine(const Vectors& normal, const soft::Points& point) {
  Floats x, y;
  soft::turn(point.v, x, y);
  const Floats radius = sqrt(point.u), height = sqrt(1.0f - point.u);
  Vectors s, t;
  soft::basis(normal, s, t);
  return shared::unit((s * x + t * y) * radius + normal * height);
}

}  // namespace

Packet Shading::diffused(const Packet& packet, const Hits& hits, std::uint32_t way,
                         std::uint32_t ways, Workspace& workspace) const {
  Packet to = packet;
  soft::Points point, chosen;
  for (unsigned i = 0; i < lane_count; ++i) {
    if (!packet.active[i]) continue;
    const auto [index, seed] = soft::pattern_of(packet, i, ways, way, of_direction);
    to.sample[i] = index;
    to.seed[i] = seed;
    soft::Pattern{index, seed}.shuffled().put(point, i);
    if (texturing_.is_needed())
      soft::Pattern{index, soft::hashed(seed, of_spectrum)}.shuffled().put(chosen, i);
  }
  to.origin = packet.point;
  to.direction = by_cosine(hits.normal, point);
  to.kind = RayKind::diffuse;
  to.from_eye = false;
  to.diffused = true;
  to.active &= dot(to.direction, hits.geometric_normal) > 0.0f;
  if (any(to.active))
    to.throughput *= scattered(packet, hits, to.direction, workspace) / static_cast<float>(ways);
  to.active &= to.throughput > 0.0f;
  for (unsigned i = 0; i < lane_count; ++i) {
    if (!to.active[i]) continue;
    if (const auto material = texturing_.choose(packet, hits, i, chosen.u[i]))
      to.chain[i] =
          workspace.gathers[to.pixel[i]].chain(to.chain[i], {FactorKind::diffuse, *material, 0});
    else
      to.active[i] = 0;
  }
  return to;
}

/// The diffuse part of what the lanes' models reflect of light from there, by that of Lambert's.
Floats Shading::scattered(const Packet& packet, const Hits& hits, const Vectors& direction,
                          Workspace& workspace) const {
  // A model that is a BRDF sees the whole of a hemisphere by the cosine, π.
  const Floats whole = metamer::broadcast(std::numbers::pi_v<float>);
  Angles angles = shared::angles_of(hits.normal, hits.tangent, direction,
                                    packet.direction * metamer::broadcast(-1), whole,
                                    needed_.azimuth, needed_.tangent);
  const Floats cosine = max(angles.n_dot_l, metamer::broadcast(1e-6f));
  Floats diffuse = evaluate_each(hits, packet.active, angles, workspace).diffuse;
  if (has_ambient_) {  // light from all around is what is looked for
    angles.n_dot_l = Floats{};
    diffuse -= evaluate_each(hits, packet.active, angles, workspace).diffuse;
  }
  return diffuse / cosine;
}

}  // namespace metamer::cpu
