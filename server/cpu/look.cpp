#include "server/cpu/look.h"

#include <limits>

#include "server/cpu/cutouts.h"
#include "server/cpu/normal_maps.h"
#include "server/cpu/shared_source.h"
#include "server/cpu/soft/soft_lights.h"
#include "server/cpu/tracer.h"

namespace metamer::cpu {
namespace {

Eigen::Vector3d first_lane(const Vectors& v) { return {v.x[0], v.y[0], v.z[0]}; }

Ints first_lane_alone() {
  Ints lanes{};
  lanes[0] = -1;
  return lanes;
}

/// What each light sends to a surface that its ray has met, by its cosine: as Shading has it.
std::vector<double> light_on(const RenderScene& scene, const EmbreeScene& geometry,
                             const Vectors& hit, const Hits& hits) {
  const Vectors lifted = hit + hits.geometric_normal * shared::lift_off(hit, hits.distance);
  const soft::SoftLights soft(scene, geometry, 1);
  std::vector<double> weights =
      soft.on_surface(geometry, hit, lifted, hits.normal, scene.lights.size());
  for (std::size_t l = 0; l < scene.lights.size(); ++l) {
    const RenderLight& light = scene.lights[l];
    if (light.source != RenderLight::Source::place) continue;
    lights::Values<Floats> values{};
    const lights::Values<double> numbers = light.values();
    for (std::size_t i = 0; i < numbers.size(); ++i)
      values[i] = metamer::broadcast(static_cast<float>(numbers[i]));
    const shared::Incident incident = shared::incident(light.light, values, hit);
    const Floats cosine = dot(hits.normal, incident.direction);
    const Ints facing = first_lane_alone() & shared::is_finite(incident) &
                        (incident.weight > 0.0f) & (cosine > 0.0f);
    const Ints lit = geometry.visible(lifted, incident.direction, incident.reach, facing);
    weights[l] = lit[0] ? double{incident.weight[0]} * double{cosine[0]} : 0;
  }
  return weights;
}

/// What the first lane meets, holes left aside, with its turned normal; packet.hit is its place.
Hits first_seen(const RenderScene& scene, const EmbreeScene& geometry, float footprint,
                Packet& packet) {
  const Cutouts cutouts(scene, geometry, footprint);
  const NormalMaps normal_maps(scene, geometry, footprint);
  packet.active = first_lane_alone();
  Hits hits = geometry.intersect(packet.origin, packet.direction, packet.active);
  Passed passed;
  for (std::size_t holes = 0; hits.hit[0]; ++holes) {
    packet.hit = packet.origin + packet.direction * hits.distance;
    packet.travelled = hits.distance;
    if (!cutouts.is_needed() || cutouts.share(packet, hits, 0) > 0 || holes == Passed::most) break;
    passed.add(0, hits.object[0], hits.primitive[0]);
    hits = geometry.intersect_others(packet.origin, packet.direction,
                                     metamer::broadcast(std::numeric_limits<float>::infinity()),
                                     packet.active, passed);
  }
  if (hits.hit[0] && normal_maps.is_needed()) normal_maps.turn(packet, hits);
  return hits;
}

/// The one sample in a pixel's middle, through that of the lens, with all that it meets.
Gather gather_middle(const RenderScene& scene, const EmbreeScene& geometry, const v1::Plan& plan,
                     std::uint32_t x, std::uint32_t y) {
  Tracer::Frame frame =
      Tracer::frame_of(plan, plan.width(), plan.height(), {SamplePoint{0.5f, 0.5f}});
  frame.lens = false;
  const Tracer tracer(scene, geometry, frame);
  auto workspace = tracer.make_workspace();
  const std::uint32_t across = x % tracer.block_width(), down = y % tracer.block_height();
  tracer.gather_blocks(std::array{Tracer::BlockCorner{x - across, y - down}}, workspace);
  return workspace.gathers[down * tracer.block_width() + across];
}

}  // namespace

std::optional<SeenPoint> look(const RenderScene& scene, const EmbreeScene& geometry,
                              const v1::Plan& plan, std::uint32_t x, std::uint32_t y) {
  const RenderCamera& camera = scene.camera;
  const double pixel = 2 * camera.tan_half_fov / plan.height();
  const Eigen::Vector3d towards = camera.forward +
                                  camera.right * (pixel * (x + 0.5 - plan.width() / 2.0)) -
                                  camera.up * (pixel * (y + 0.5 - plan.height() / 2.0));
  Packet packet;
  packet.origin = to_lanes(camera.eye);
  packet.direction = to_lanes(towards.normalized());
  const Hits hits = first_seen(scene, geometry, static_cast<float>(pixel), packet);
  if (!hits.hit[0]) return std::nullopt;
  const Vectors& hit = packet.hit;
  return SeenPoint{.object = static_cast<std::uint32_t>(hits.object[0]),
                   .place = first_lane(hit),
                   .normal = first_lane(hits.normal).normalized(),
                   .eye = gather_middle(scene, geometry, plan, x, y),
                   .light = light_on(scene, geometry, hit, hits)};
}

}  // namespace metamer::cpu
