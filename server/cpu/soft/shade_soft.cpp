// How a Shading looks at lights that are no place or direction: at some of their points.

#include <limits>

#include "server/cpu/lane_vectors.h"
#include "server/cpu/shading.h"
#include "server/cpu/shared_source.h"

namespace metamer::cpu {

/// A path that has been scattered is one of many.
std::uint32_t Shading::light_samples(const Packet& packet) const {
  return packet.diffused ? 1 : soft_.samples();
}

void Shading::shade_soft(const Packet& packet, const Hits& hits, const Places& places, Ints ambient,
                         Workspace& workspace) const {
  // The models are evaluated at the hit, whatever the object's shading is.
  Hits here = hits;
  here.interpolated = Ints{};
  const std::uint32_t samples = light_samples(packet);
  const float share = 1 / static_cast<float>(samples);
  for (const soft::SoftLights::Surface& surface : soft_.surfaces()) {
    const soft::SurfaceLight::View view = surface.view(packet.hit, packet.active, hits);
    if (!any(view.lanes)) continue;
    const Step step{packet, here, places, surface.light, workspace};
    for (std::uint32_t j = 0; j < samples; ++j) {
      soft::Points point;
      for (unsigned i = 0; i < lane_count; ++i)
        if (view.lanes[i]) soft::pattern_of(packet, i, samples, j, surface.light).put(point, i);
      const soft::Samples sample = surface.sample(view, point, packet.point);
      const Ints sound = view.lanes & (sample.weight > 0.0f) &
                         (sample.weight <= std::numeric_limits<float>::max());
      const Ints facing =
          sound & (dot(hits.normal, sample.direction) > 0.0f) & reached(hits, sample.direction);
      const Floats weight = sample.weight * share;
      if (media_ != nullptr)
        shade_through(step, facing, ambient, sample.direction, sample.reach, weight);
      const Ints lit = lit_by(step, sample.direction, sample.reach, facing);
      const Ints wanted = lit | (ambient & sound);
      if (any(wanted)) reflect(step, lit, wanted, sample.direction, weight);
    }
  }
  if (soft_.sky()) shade_by_sky(packet, here, places, ambient, workspace);
}

void Shading::shade_by_sky(const Packet& packet, const Hits& hits, const Places& places,
                           Ints ambient, Workspace& workspace) const {
  const soft::Sky& sky = *soft_.sky();
  const std::uint32_t samples = light_samples(packet);
  const float share = 1 / static_cast<float>(samples);
  const Floats far = metamer::broadcast(std::numeric_limits<float>::max());
  const auto step_of = [&](std::uint32_t part) {
    return Step{packet, hits, places, sky.first_light() + part, workspace};
  };
  for (std::uint32_t j = 0; j < samples; ++j) {
    soft::Sky::Samples sample;
    for (unsigned i = 0; i < lane_count; ++i) {
      if (!packet.active[i]) continue;
      const auto [index, seed] = soft::pattern_of(packet, i, samples, j, sky.first_light());
      sky.put_sample(lane_of(hits.normal, i), index, seed, sample, i);
    }
    const Ints sound = packet.active & (sample.weight > 0.0f);
    const Ints facing =
        sound & (dot(hits.normal, sample.direction) > 0.0f) & reached(hits, sample.direction);
    const Floats weight = sample.weight * share;
    for (std::uint32_t part = 0; media_ != nullptr && part < sky.light_count(); ++part)
      shade_through(step_of(part), facing, ambient, sample.direction, far,
                    weight * sky.radiance_of(sample, part));
    const Ints lit = lit_by(step_of(0), sample.direction, far, facing);
    const Ints wanted = lit | (ambient & sound);
    if (!any(wanted)) continue;

    // One direction, one ray, one evaluation: each light of the picture has a weight of its own.
    const Lobes whole = evaluate_hits(step_of(0), wanted, lit, sample.direction, weight);
    for (std::uint32_t part = 0; part < sky.light_count(); ++part) {
      Lobes own = whole;
      scale(own, sky.radiance_of(sample, part));
      gather(step_of(part), own, wanted);
    }
  }
}

/// The lanes that see what is there; of a scene with clear objects none: shade_through() has them.
Ints Shading::lit_by(const Step& step, const Vectors& direction, Floats reach, Ints facing) const {
  if (media_ != nullptr || !any(facing)) return Ints{};
  step.workspace.add_rays(RayKind::shadow, facing);
  return geometry_.visible(step.packet.point, direction, reach, facing);
}

}  // namespace metamer::cpu
