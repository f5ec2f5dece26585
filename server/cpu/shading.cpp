#include "server/cpu/shading.h"

#include "common/scene/rough_lobe_table.h"
#include "server/cpu/clear_shadows.h"
#include "server/cpu/shared_source.h"
#include "server/cpu/ticks.h"
#include "server/transport/expand.h"

namespace metamer::cpu {
namespace {

/// The same lane in all.
Vectors broadcast_lane(const Vectors& v, int lane) {
  return {metamer::broadcast(v.x[lane]), metamer::broadcast(v.y[lane]),
          metamer::broadcast(v.z[lane])};
}

static_assert(static_cast<int>(FresnelKind::none) == shared::fresnel_none &&
              static_cast<int>(FresnelKind::schlick) == shared::fresnel_schlick &&
              static_cast<int>(FresnelKind::exact) == shared::fresnel_exact);

static_assert(v1::CONSTANT == shared::constant_shading && v1::GOURAUD == shared::gouraud_shading &&
              v1::QUADRATIC == shared::quadratic_shading);

/// The places of a triangle, one a lane; lanes beyond the last one repeat the first.
shared::Place places_of(const Corners& corners, const Vectors& side, int shading) {
  shared::Triangle at;
  for (std::size_t i = 0; i < 3; ++i) {
    at.position[i] = metamer::broadcast(corners.position[i]);
    at.normal[i] = metamer::broadcast(corners.normal[i]);
    at.tangent[i] = metamer::broadcast(corners.tangent[i]);
  }
  at.across = metamer::broadcast(corners.across);
  Floats place{};
  for (int i = 0; i < shared::place_count(shading); ++i) place[i] = static_cast<float>(i);
  return shared::place_of(at, side, shading, place);
}

}  // namespace

Shading::Shading(const RenderScene& scene, const EmbreeScene& geometry, float footprint,
                 std::uint32_t light_samples, const Media* media)
    : scene_(scene),
      geometry_(geometry),
      media_(media),
      texturing_(scene, geometry, footprint),
      normal_maps_(scene, geometry, footprint),
      soft_(scene, geometry, light_samples),
      needed_(needed_angles(scene)),
      own_side_(normal_maps_.is_needed() || scene.has_alpha()) {
  for (const RenderLight& light : scene.lights) {
    Light& to = lights_.emplace_back();
    to.is_place = light.source == RenderLight::Source::place;
    to.light = light.light;
    to.solid_angle = metamer::broadcast(static_cast<float>(light.solid_angle));
    const lights::Values<double> values = light.values();
    for (std::size_t i = 0; i < values.size(); ++i)
      to.values[i] = metamer::broadcast(static_cast<float>(values[i]));
  }
  for (const RenderMaterial& material : scene.materials) {
    has_ambient_ |= material.has(models::has_ambient);
    has_rough_ |= material.has(models::diffracting);
    has_factors_ |= has_rough_ || material.fresnel == FresnelKind::exact;
  }
}

void Shading::shade(const Packet& packet, const Hits& hits, Workspace& workspace) const {
  const Places places = find_places(packet, hits, workspace);
  const Ints ambient = ambient_lanes(hits, packet.active);
  if (!soft_.empty()) shade_soft(packet, hits, places, ambient, workspace);
  for (std::size_t l = 0; l < lights_.size(); ++l) {
    if (!lights_[l].is_place) continue;
    // Look towards the light from the surface itself: the lift would show in a near light.
    const shared::Incident light =
        shared::incident(lights_[l].light, lights_[l].values, packet.hit);
    const Ints sound = shared::is_finite(light);
    const Ints shone = (light.weight > 0.0f) & (dot(hits.normal, light.direction) > 0.0f);
    const Ints facing =
        packet.active & sound & (shone | hits.interpolated) & reached(hits, light.direction);
    Ints lit{};
    const Step step{packet, hits, places, static_cast<std::uint32_t>(l), workspace};
    if (media_ != nullptr) {
      shade_through(step, facing, ambient, light.direction, light.reach, light.weight);
    } else if (any(facing)) {
      workspace.add_rays(RayKind::shadow, facing);
      lit = geometry_.visible(packet.point, light.direction, light.reach, facing);
    }
    const Ints wanted = lit | (ambient & sound);
    if (any(wanted)) reflect(step, lit, wanted, light.direction, light.weight);
  }
}

/// The lanes that are not in their own surface's way: where a normal is turned it may see what is
/// below, and what is not all there would let it through.
Ints Shading::reached(const Hits& hits, const Vectors& direction) const {
  return own_side_ ? Ints(dot(hits.geometric_normal, direction) > 0.0f) : Ints{} - 1;
}

/// Evaluates the models where they are asked for, and gathers their lobes.
void Shading::reflect(const Step& step, Ints lit, Ints wanted, const Vectors& to_light,
                      Floats weight) const {
  const Ints between = lit & step.hits.interpolated;
  Lobes lobes = evaluate_hits(step, wanted & ~between, lit, to_light, weight);
  if (any(between)) interpolate(step, between, lobes);
  gather(step, lobes, wanted);
}

/// The same of lanes whose light comes through clear things, each over a chain of its own.
void Shading::shade_through(const Step& step, Ints lanes, Ints ambient, const Vectors& to_light,
                            Floats reach, Floats weight) const {
  if (!any(lanes)) return;
  Packet packet = step.packet;
  packet.active = lanes;
  light_through(*media_, geometry_, to_light, reach, packet, step.workspace);
  if (!any(packet.active)) return;
  std::vector<TextureShare> shares = std::move(step.workspace.texture_shares);
  const Places places = find_places(packet, step.hits, step.workspace);
  const Step through{packet, step.hits, places, step.light, step.workspace};
  reflect(through, packet.active, packet.active, to_light, weight);
  // What is reflected without any light has been gathered without anything on its way.
  if (const Ints unlit = ambient & packet.active; any(unlit))
    reflect(through, Ints{}, unlit, to_light, weight * metamer::broadcast(-1));
  step.workspace.texture_shares = std::move(shares);
}

/// Finds where each lane's light is gathered.
Shading::Places Shading::find_places(const Packet& packet, const Hits& hits,
                                     Workspace& workspace) const {
  Places places;
  for (unsigned group = 0; group < group_count; ++group) {
    int last = -1;
    bool together = true;
    for (unsigned i = group * group_size; i < (group + 1) * group_size; ++i) {
      if (!packet.active[i]) continue;
      const auto material = static_cast<std::uint32_t>(hits.material[i]);
      const bool as_last = last >= 0 && packet.pixel[i] == packet.pixel[last] &&
                           packet.chain[i] == packet.chain[last] &&
                           hits.material[i] == hits.material[last];
      places.surface[i] =
          as_last ? places.surface[last]
                  : workspace.gathers[packet.pixel[i]].surface(packet.chain[i], material);
      together &= last < 0 || as_last;
      last = static_cast<int>(i);
    }
    places.together[group] = together;
    places.first[group] = static_cast<unsigned>(last);
  }
  if (texturing_.is_needed()) places.own_diffuse = texturing_.divide(packet, hits, workspace);
  return places;
}

/// The lanes whose material reflects light also where no light of the scene reaches.
Ints Shading::ambient_lanes(const Hits& hits, Ints active) const {
  Ints lanes{};
  if (!has_ambient_) return lanes;
  for (int i = 0; i < lane_count; ++i)
    if (active[i] &&
        scene_.materials[static_cast<std::size_t>(hits.material[i])].has(models::has_ambient))
      lanes[i] = -1;
  return lanes;
}

Shading::Lobes Shading::evaluate(const RenderMaterial& material, const Angles& angles,
                                 Workspace& workspace) const {
  const bool timed = workspace.evaluations++ % timed_each == 0;
  const std::uint64_t start = timed ? ticks() : 0;
  const Lobes lobes = models::evaluate_packet(material.reflection, angles);
  if (timed) workspace.timed_ticks += ticks() - start;
  return shared::fold_fresnel(lobes, static_cast<int>(material.fresnel));
}

/// Evaluates each material that the lanes have hit, once for all of its lanes. Where a lane is not
/// lit, N·L is 0. Flat: the compiler would call what interpolate() calls as well, for 4 % of a
/// picture.
[[gnu::flatten]] Shading::Lobes Shading::evaluate_hits(const Step& step, Ints lanes, Ints lit,
                                                       const Vectors& to_light,
                                                       Floats weight) const {
  if (!any(lanes)) return Lobes{};
  const Hits& hits = step.hits;
  Angles angles = shared::angles_of(
      hits.normal, hits.tangent, to_light, step.packet.direction * metamer::broadcast(-1),
      lights_[step.light].solid_angle, needed_.azimuth, needed_.tangent);
  angles.n_dot_l = select(lit, angles.n_dot_l, Floats{});
  Lobes lobes = evaluate_each(hits, lanes, angles, step.workspace);
  scale(lobes, select(lanes, weight * step.packet.throughput, Floats{}));
  return lobes;
}

Shading::Lobes Shading::evaluate_each(const Hits& hits, Ints lanes, const Angles& angles,
                                      Workspace& workspace) const {
  Lobes lobes{};
  Ints left = lanes;
  for (int first = 0; first < lane_count; ++first) {
    if (!left[first]) continue;
    const Ints same = left & (hits.material == hits.material[first]);
    const Lobes own = evaluate(scene_.materials[static_cast<std::size_t>(hits.material[first])],
                               angles, workspace);
    lobes.diffuse = select(same, own.diffuse, lobes.diffuse);
    lobes.specular = select(same, own.specular, lobes.specular);
    lobes.white = select(same, own.white, lobes.white);
    lobes.fresnel = select(same, own.fresnel, lobes.fresnel);
    lobes.cosine = select(same, own.cosine, lobes.cosine);
    if (has_rough_) {
      lobes.height = select(same, own.height, lobes.height);
      lobes.spread = select(same, own.spread, lobes.spread);
    }
    left &= ~same;
  }
  return lobes;
}

/// Adds the lobes of lanes whose model is evaluated at places of the triangle: once for all lanes
/// of a group on it, since its places are the same for all. Seen over mirrors, or by a lens, each
/// lane has an eye of its own.
void Shading::interpolate(const Step& step, Ints lanes, Lobes& lobes) const {
  const Hits& hits = step.hits;
  const Packet& packet = step.packet;
  // Where the eye seems to be: as far behind the mirrors as the light has come.
  const Vectors eye = packet.hit - packet.direction * packet.travelled;
  Ints left = lanes;
  for (int first = 0; first < lane_count; ++first) {
    if (!left[first]) continue;
    Ints same =
        left & (hits.object == hits.object[first]) & (hits.primitive == hits.primitive[first]);
    if (group_count > 1) same &= lanes_of(static_cast<unsigned>(first) / group_size);
    if (!packet.from_eye || packet.from_lens) {
      same = Ints{};
      same[first] = -1;
    }
    left &= ~same;

    // Evaluate the model at the triangle's places.
    const int shading = static_cast<int>(geometry_.shading(hits.object[first]));
    const shared::Place places =
        places_of(geometry_.corners(hits.object[first], hits.primitive[first]),
                  broadcast_lane(hits.geometric_normal, first), shading);
    const Light& from = lights_[step.light];
    const shared::Incident light = shared::incident(from.light, from.values, places.position);
    const Vectors to_eye = shared::unit(broadcast_lane(eye, first) - places.position);
    const RenderMaterial& material =
        scene_.materials[static_cast<std::size_t>(hits.material[first])];
    Lobes own = evaluate(material,
                         shared::angles_of(places.normal, places.tangent, light.direction, to_eye,
                                           from.solid_angle, needed_.azimuth, needed_.tangent),
                         step.workspace);
    scale(own, select(shared::is_finite(light), light.weight, Floats{}));

    // Interpolate between them.
    const Floats throughput = select(same, packet.throughput, Floats{});
    for (int p = 0; p < shared::place_count(shading); ++p) {
      const Floats weight = shared::place_weight(shading, p, hits.u, hits.v) * throughput;
      lobes.diffuse += weight * own.diffuse[p];
      lobes.specular += weight * own.specular[p];
      lobes.white += weight * own.white[p];
      if (own.fresnel[p] == 0 || packet.diffused) continue;  // as gather() has it
      Lobes one{};
      one.fresnel = select(same, weight * own.fresnel[p], Floats{});
      one.cosine = metamer::broadcast(own.cosine[p]);
      one.height = metamer::broadcast(own.height[p]);
      one.spread = metamer::broadcast(own.spread[p]);
      gather_factors(step, one);
    }
  }
}

void Shading::gather_fresnel(const Step& step, int lane, float cosine, float weight) {
  const auto i = static_cast<std::size_t>(lane);
  Gather& gather = step.workspace.gathers[step.packet.pixel[i]];
  const auto material = static_cast<std::uint32_t>(step.hits.material[i]);
  const FactorNodes<float> nodes = expand<float>({FactorKind::fresnel, material, cosine});
  for (std::size_t j = 0; j < nodes.count; ++j)
    gather.add(step.packet.chain[i], step.light, nodes.node[j], weight * nodes.weight[j]);
}

/// Adds what of the lobes is no spectrum of the scene: Fresnel terms, and lobes of rough surfaces.
void Shading::gather_factors(const Step& step, const Lobes& lobes) const {
  if (has_rough_ && any((lobes.height >= 0.0f) & (lobes.fresnel != 0.0f)))
    gather_rough(step, lobes);
  for (int i = 0; i < lane_count; ++i)
    if (lobes.fresnel[i] != 0 && !(has_rough_ && lobes.height[i] >= 0))
      gather_fresnel(step, i, lobes.cosine[i], lobes.fresnel[i]);
}

/// A weight for each of the wavelengths at which the lobe's geometry is known, between two cosines.
void Shading::gather_rough(const Step& step, const Lobes& lobes) const {
  const Ints rough = (lobes.height >= 0.0f) & (lobes.fresnel != 0.0f);
  const Floats height = select(rough, lobes.height, Floats{}),
               spread = select(rough, lobes.spread, Floats{});
  std::array<Floats, lobe_wavelengths> weights;
  for (std::uint32_t w = 0; w < lobe_wavelengths; ++w)
    weights[w] =
        lobes.fresnel * models::ripples_of_packet(height, spread, static_cast<float>(lobe_nm(w)));
  for (int lane = 0; lane < lane_count; ++lane) {
    if (!rough[lane]) continue;
    const auto i = static_cast<std::size_t>(lane);
    Gather& gather = step.workspace.gathers[step.packet.pixel[i]];
    const auto material = static_cast<std::uint32_t>(step.hits.material[i]);
    // C_S is the same at all angles: that of light at right angles.
    const FresnelPlace place = lobe_place(
        scene_.materials[material].fresnel == FresnelKind::none ? 1 : lobes.cosine[lane]);
    for (std::uint32_t w = 0; w < lobe_wavelengths; ++w) {
      const FactorNode below{FactorKind::lobe, material, place.below * lobe_wavelengths + w};
      const FactorNode above{FactorKind::lobe, material, below.node + lobe_wavelengths};
      const float weight = weights[w][lane];
      gather.add(step.packet.chain[i], step.light, below, weight * (1 - place.fraction));
      gather.add(step.packet.chain[i], step.light, above, weight * place.fraction);
    }
  }
}

/// Adds weighted lobes where they are gathered; the lanes that have none hold zeros.
void Shading::gather(const Step& step, Lobes lobes, Ints lanes) const {
  Workspace& workspace = step.workspace;
  // What a highlight throws on a surface is not looked for: it would take too many ways to meet it.
  if (step.packet.diffused) lobes.specular = lobes.white = lobes.fresnel = Floats{};
  if (texturing_.is_needed()) {
    for (const TextureShare& share : workspace.texture_shares)
      if (any_of(lanes, share.lane / group_size))
        workspace.gathers[step.packet.pixel[share.lane]]
            .weights(share.surface, step.light)
            .diffuse += share.weight * lobes.diffuse[share.lane];
    lobes.diffuse *= step.places.own_diffuse;
  }
  const Places& places = step.places;
  if (has_factors_) gather_factors(step, lobes);
  for (unsigned group = 0; group < group_count; ++group) {
    if (!any_of(lanes, group)) continue;
    if (places.together[group]) {
      const unsigned first = places.first[group];
      LobeWeights& to =
          workspace.gathers[step.packet.pixel[first]].weights(places.surface[first], step.light);
      to.diffuse += sum(lobes.diffuse, group);
      to.specular += sum(lobes.specular, group);
      to.white += sum(lobes.white, group);
      continue;
    }
    for (unsigned i = group * group_size; i < (group + 1) * group_size; ++i) {
      if (!lanes[i]) continue;
      LobeWeights& to =
          workspace.gathers[step.packet.pixel[i]].weights(places.surface[i], step.light);
      to.diffuse += lobes.diffuse[i];
      to.specular += lobes.specular[i];
      to.white += lobes.white[i];
    }
  }
}

}  // namespace metamer::cpu
