#include "server/cpu/soft/soft_lights.h"

#include <limits>

#include "server/cpu/lane_vectors.h"
#include "server/cpu/soft/object_light.h"

namespace metamer::cpu::soft {
namespace {

void add_white(const Packet& packet, unsigned lane, std::uint32_t light, float weight,
               Workspace& workspace) {
  if (weight > 0)
    workspace.gathers[packet.pixel[lane]].add(packet.chain[lane], light,
                                              FactorNode{FactorKind::white, 0, 0},
                                              weight * packet.throughput[lane]);
}

}  // namespace

SoftLights::SoftLights(const RenderScene& scene, const EmbreeScene& geometry, std::uint32_t samples)
    : samples_(samples) {
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
    const RenderLight& light = scene.lights[i];
    if (light.source == RenderLight::Source::surface)
      surfaces_.push_back({i, light.visible, SurfaceLight(light)});
    if (light.source != RenderLight::Source::object) continue;
    // What is no instance has triangles as its map turns them.
    const RenderObject& object = scene.objects[light.object];
    const auto number = static_cast<int>(light.object);
    const bool mirrored = object.shape == RenderObject::Shape::mesh &&
                          !geometry.is_instance(number) &&
                          object.to_world.linear().determinant() < 0;
    of_object_.resize(scene.objects.size(), -1);
    of_object_[light.object] = static_cast<int>(surfaces_.size());
    surfaces_.push_back({i, light.visible, object_light(scene, light), number, mirrored});
  }
  if (scene.environment) sky_.emplace(scene);
}

Samples SoftLights::Surface::sample(const SurfaceLight::View& view, const Points& point,
                                    const Vectors& lifted) const {
  Samples sample = shape.sample(view, point);
  if (object < 0) return sample;
  const Vectors way = view.at + sample.direction * (sample.reach / reached) - lifted;
  const Floats distance = sqrt(dot(way, way));
  sample.direction = way / max(distance, broadcast(1e-30F));
  sample.reach = distance * reached;
  return sample;
}

SoftLights::Seen SoftLights::find(const Packet& packet, Hits& hits) const {
  // A surface that shines and lies in what was hit is before it.
  constexpr float infinity = std::numeric_limits<float>::infinity();
  constexpr float before = 1 + 1e-5F;
  Seen seen{.surface = Ints{} - 1,
            .distance = select(hits.hit, hits.distance * before, metamer::broadcast(infinity)),
            .sky = {}};
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    if (surfaces_[i].object >= 0 || (packet.from_eye && !surfaces_[i].visible)) continue;
    const Floats distance = surfaces_[i].shape.meet(packet.origin, packet.direction);
    const Ints nearer = packet.active & (distance < seen.distance);
    seen.distance = select(nearer, distance, seen.distance);
    seen.surface = nearer ? Ints{} + static_cast<int>(i) : seen.surface;
  }
  hits.hit &= seen.surface < 0;
  if (sky_ && (sky_->visible() || !packet.from_eye))
    seen.sky = packet.active & ~hits.hit & (seen.surface < 0);
  return seen;
}

void SoftLights::add(const Packet& packet, const Seen& seen, Workspace& workspace) const {
  for (unsigned i = 0; i < lane_count; ++i) {
    if (seen.surface[i] >= 0) {
      const Surface& surface = surfaces_[static_cast<std::size_t>(seen.surface[i])];
      add_white(packet, i, surface.light, surface.shape.radiance(), workspace);
    } else if (seen.sky[i]) {
      const float* values = sky_->values(lane_of(packet.direction, i));
      for (std::uint32_t part = 0; part < sky_->light_count(); ++part)
        add_white(packet, i, sky_->first_light() + part, sky_->radiance(values[part]), workspace);
    }
  }
}

void SoftLights::add_objects(const Packet& packet, const Hits& hits, Ints lanes,
                             Workspace& workspace) const {
  if (of_object_.empty() || packet.diffused) return;
  for (unsigned i = 0; i < lane_count; ++i) {
    if (!lanes[i]) continue;
    const int index = of_object_[static_cast<std::size_t>(hits.object[i])];
    if (index < 0) continue;
    const Surface& surface = surfaces_[static_cast<std::size_t>(index)];
    if ((hits.behind[i] != 0) != surface.mirrored || (packet.from_eye && !surface.visible))
      continue;
    add_white(packet, i, surface.light, surface.shape.radiance(), workspace);
  }
}

std::vector<double> SoftLights::on_surface(const EmbreeScene& geometry, const Vectors& hit,
                                           const Vectors& lifted, const Vectors& normal,
                                           std::size_t lights) const {
  constexpr std::uint32_t points = 1024;
  const Ints all = Ints{} - 1;
  std::vector<double> sums(lights);
  const auto by_cosine = [&](const Vectors& direction, Floats reach, Floats weight) {
    const Floats cosine = dot(normal, direction);
    const Ints lit =
        geometry.visible(lifted, direction, reach, all & (weight > 0.0f) & (cosine > 0.0f));
    return select(lit, weight * cosine, Floats{});
  };
  for (const Surface& surface : surfaces_) {
    const SurfaceLight::View view = surface.shape.view(hit, all);
    for (std::uint32_t j = 0; j < points; j += lane_count) {
      Points point;
      for (unsigned i = 0; i < lane_count; ++i) Pattern{j + i, 0}.put(point, i);
      const auto sample = surface.sample(view, point, lifted);
      const Floats lit = by_cosine(sample.direction, sample.reach, sample.weight);
      for (unsigned group = 0; group < group_count; ++group)
        sums[surface.light] += double{sum(lit, group)} / points;
    }
  }
  for (std::uint32_t j = 0; sky_ && j < points; j += lane_count) {
    Sky::Samples sample;
    for (unsigned i = 0; i < lane_count; ++i)
      sky_->put_sample(lane_of(normal, i), j + i, 0, sample, i);
    const Floats lit = by_cosine(
        sample.direction, metamer::broadcast(std::numeric_limits<float>::max()), sample.weight);
    for (std::uint32_t part = 0; part < sky_->light_count(); ++part)
      for (unsigned group = 0; group < group_count; ++group)
        sums[sky_->first_light() + part] +=
            double{sum(lit * sky_->radiance_of(sample, part), group)} / points;
  }
  return sums;
}

}  // namespace metamer::cpu::soft
