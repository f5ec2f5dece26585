#include "server/cpu/ray_tree.h"

#include <cmath>

#include "server/cpu/refraction.h"
#include "server/cpu/shared_source.h"
#include "server/transport/mirror.h"

namespace metamer::cpu {
namespace {

/// Surfaces that a path may meet without end, of objects that lie in each other.
constexpr unsigned most_surfaces = 1024;

}  // namespace

RayTree::RayTree(const RenderScene& scene, const EmbreeScene& geometry, const Media& media,
                 const Shading& shading, unsigned depth, float cutoff, const Diffusion& diffusion)
    : scene_(scene),
      geometry_(geometry),
      media_(media),
      shading_(shading),
      depth_(depth),
      cutoff_(cutoff),
      diffusion_(diffusion) {}

void RayTree::trace(const Packet& camera, Workspace& workspace) const {
  workspace.camera_rays += count(camera.active);
  std::vector<Branch> stack(1);
  stack.back().packet = camera;
  stack.back().inside.fill(media_.of_eye());
  stack.back().from = camera.origin;
  while (!stack.empty()) {
    Branch branch = stack.back();
    stack.pop_back();
    follow(branch, stack, workspace);
  }
}

/// What the branch meets next: its light, and its children.
void RayTree::follow(Branch& branch, std::vector<Branch>& stack, Workspace& workspace) const {
  Packet& packet = branch.packet;
  workspace.add_rays(packet.kind, packet.active);
  Hits hits = geometry_.intersect(packet.origin, packet.direction, packet.active);
  if (!shading_.soft().empty()) see(branch, hits, workspace);
  packet.active = hits.hit;
  if (!any(packet.active)) return;
  packet.hit = packet.origin + packet.direction * hits.distance;
  packet.travelled += hits.distance;
  absorb(branch, workspace);

  // Go through clear surfaces and holes, unless an opaque one touches them.
  Media::Crossing crossing;
  if (const Ints passable = media_.passable(packet, hits); any(passable))
    crossing = media_.cross(packet, hits, passable, branch.inside);
  packet.point = packet.hit + hits.geometric_normal * shared::lift_off(packet.hit, hits.distance);
  shading_.turn_normals(packet, hits);

  // Gather the light of surfaces that shine, and what they reflect by their models.
  shading_.soft().add_objects(packet, hits, packet.active & ~crossing.passed, workspace);
  const Ints layered = crossing.layer > 0.0f;
  Packet shaded = packet;
  shaded.active = shaded_lanes(branch, hits, crossing, crossing.passed);
  shaded.throughput *= select(layered, crossing.layer, metamer::broadcast(1));
  shaded.inside = &branch.inside;
  if (any(shaded.active)) {
    shading_.shade(shaded, hits, workspace);
    if (branch.bounces < diffusion_.bounces) diffuse(branch, shaded, hits, stack, workspace);
  }
  if (any(layered)) mirror_layers(branch, hits, shaded, layered, stack, workspace);
  packet.throughput *= 1.0f - crossing.layer;

  Children children = children_of(branch);
  split(branch, hits, crossing, children, workspace);
  for (unsigned i = 0; i < lane_count; ++i)
    if (packet.active[i] && !crossing.passed[i]) mirror(branch, hits, i, children, workspace);
  push_all(children, stack, workspace);
  if (any(children.dispersed))
    disperse(branch, hits, crossing, children.dispersed, stack, workspace);
}

/// None of whose paths are active yet.
RayTree::Children RayTree::children_of(const Branch& branch) const {
  Children children;
  for (Branch* child : {&children.reflected, &children.transmitted, &children.straight}) {
    *child = branch;
    child->from = branch.packet.hit;
    child->packet.active = Ints{};
    child->surfaces = branch.surfaces + 1;
  }
  for (Branch* child : {&children.reflected, &children.transmitted}) {
    child->depth = branch.depth + 1;
    child->packet.from_eye = false;
  }
  children.reflected.packet.kind = RayKind::mirror;
  children.transmitted.packet.kind = children.straight.packet.kind = RayKind::transmitted;
  return children;
}

void RayTree::push_all(Children& children, std::vector<Branch>& stack, Workspace& workspace) const {
  push(children.straight, stack, workspace);
  push(children.transmitted, stack, workspace);
  push(children.reflected, stack, workspace);
}

/// What shines itself, through what absorbs before it; all of it where that has no end. A surface
/// that scatters has looked at it already.
void RayTree::see(const Branch& branch, Hits& hits, Workspace& workspace) const {
  soft::SoftLights::Seen seen = shading_.soft().find(branch.packet, hits);
  if (branch.packet.diffused) return;
  Branch seeing = branch;
  Packet& packet = seeing.packet;
  packet.active = seen.surface >= 0;
  packet.hit = packet.origin + packet.direction * seen.distance;
  if (any(packet.active)) absorb(seeing, workspace);
  for (unsigned i = 0; i < lane_count; ++i)
    if (media_.strength(branch.inside[i].top()) > 0) seen.sky[i] = 0;
  shading_.soft().add(packet, seen, workspace);
}

/// On the way to what was hit (Beer and Lambert), from the surface itself: a lift would be missing.
void RayTree::absorb(Branch& branch, Workspace& workspace) const {
  Packet& packet = branch.packet;
  const Vectors way = packet.hit - branch.from;
  for (unsigned i = 0; i < lane_count; ++i) {
    if (!packet.active[i]) continue;
    const std::uint8_t medium = branch.inside[i].top();
    if (!(media_.strength(medium) > 0)) continue;
    const float length = media_.strength(medium) * lane_of(way, i).norm();
    packet.chain[i] = workspace.gathers[packet.pixel[i]].chain(
        packet.chain[i], {FactorKind::absorb, media_.material(medium), length});
    branch.importance[i] *= std::exp(-media_.weakest(medium) * length);
  }
}

/// Mirrors of what is there by a share, beside what shows through it.
void RayTree::mirror_layers(const Branch& branch, const Hits& hits, const Packet& shaded,
                            Ints layered, std::vector<Branch>& stack, Workspace& workspace) const {
  Branch layer = branch;
  layer.packet.throughput = shaded.throughput;
  Children children = children_of(layer);
  for (unsigned i = 0; i < lane_count; ++i)
    if (layered[i]) mirror(layer, hits, i, children, workspace);
  push(children.reflected, stack, workspace);
}

/// Opaque surfaces, what is there of others, and clear ones from outside where the medium changes.
Ints RayTree::shaded_lanes(const Branch& branch, const Hits& hits, const Media::Crossing& crossing,
                           Ints clear) const {
  Ints lanes = branch.packet.active & ~clear;
  for (unsigned i = 0; i < lane_count; ++i)
    if (clear[i] && media_.is_clear(hits.object[i]) &&
        media_.is_front(hits.object[i], hits.behind[i] != 0) &&
        branch.inside[i].top() != crossing.inside[i].top())
      lanes[i] = -1;
  return lanes | (clear & (crossing.layer > 0.0f));
}

/// Reflection and refraction, where clear surfaces were passed.
void RayTree::split(const Branch& branch, const Hits& hits, const Media::Crossing& crossing,
                    Children& children, Workspace& workspace) const {
  for (unsigned i = 0; i < lane_count; ++i) {
    if (!crossing.passed[i]) continue;
    const std::uint8_t from = branch.inside[i].top(), to = crossing.inside[i].top();
    const Media::Interface* interface = from == to ? nullptr : media_.between(from, to);
    if (crossing.lost[i] || (interface != nullptr && branch.depth == depth_)) {
      end(branch, i, workspace.beyond_depth);
    } else if (interface != nullptr && !interface->ratios.empty() && branch.bundle[i] < 0) {
      children.dispersed[i] = -1;
    } else if (interface != nullptr) {
      refract_at(*interface, branch, hits, crossing, i, children, workspace, Parts::both);
    } else {
      set_lane(children.straight.packet.origin, lane_of(crossing.beyond, i), i);
      children.straight.packet.active[i] = -1;
      children.straight.inside[i] = crossing.inside[i];
    }
  }
}

/// Each bundle of wavelengths on a way of its own, of lanes that have had all of them together.
void RayTree::disperse(const Branch& branch, const Hits& hits, const Media::Crossing& crossing,
                       Ints lanes, std::vector<Branch>& stack, Workspace& workspace) const {
  const auto between = [&](unsigned lane) -> const Media::Interface& {
    return *media_.between(branch.inside[lane].top(), crossing.inside[lane].top());
  };
  // From the rarer side they are all reflected alike.
  Children together = children_of(branch);
  for (unsigned i = 0; i < lane_count; ++i)
    if (lanes[i] && between(i).from_rare)
      refract_at(between(i), branch, hits, crossing, i, together, workspace, Parts::reflected);
  push_all(together, stack, workspace);

  const std::uint32_t bundles = media_.bundles();
  for (std::uint32_t bundle = 0; bundle < bundles; ++bundle) {
    Branch own = branch;
    own.packet.active = lanes;
    own.importance /= static_cast<float>(bundles);
    for (unsigned i = 0; i < lane_count; ++i) {
      if (!lanes[i]) continue;
      own.bundle[i] = static_cast<int>(bundle);
      own.packet.chain[i] = workspace.gathers[own.packet.pixel[i]].chain(
          own.packet.chain[i], {FactorKind::window, bundle, 0});
    }
    Children children = children_of(own);
    for (unsigned i = 0; i < lane_count; ++i) {
      if (!lanes[i]) continue;
      const Media::Interface& interface = between(i);
      refract_at(interface, own, hits, crossing, i, children, workspace,
                 interface.from_rare ? Parts::transmitted : Parts::both);
    }
    push_all(children, stack, workspace);
  }
}

void RayTree::refract_at(const Media::Interface& interface, const Branch& branch, const Hits& hits,
                         const Media::Crossing& crossing, unsigned lane, Children& children,
                         Workspace& workspace, Parts parts) const {
  const Packet& packet = branch.packet;
  const Refraction bent =
      refract(lane_of(packet.direction, lane), lane_of(hits.normal, lane),
              lane_of(hits.geometric_normal, lane),
              branch.bundle[lane] < 0 || interface.ratios.empty()
                  ? interface.ratio
                  : interface.ratios[static_cast<std::size_t>(branch.bundle[lane])]);
  Gather& gather = workspace.gathers[packet.pixel[lane]];
  const float cosine = interface.from_rare ? bent.cosine_from : bent.cosine_to;
  const auto go_on = [&](Branch& child, const Eigen::Vector3f& direction, const Vectors& origin) {
    child.packet.active[lane] = -1;
    set_lane(child.packet.direction, direction, lane);
    set_lane(child.packet.origin, lane_of(origin, lane), lane);
  };
  const auto weigh = [&](Branch& child, FactorKind kind, float share) {
    child.importance[lane] *= share;
    if (child.bounces == 0 && child.importance[lane] * packet.throughput[lane] < cutoff_)
      return;  // push() ends it
    child.packet.chain[lane] = gather.chain(packet.chain[lane], {kind, interface.number, cosine});
  };
  if (parts != Parts::transmitted) {
    go_on(children.reflected, bent.reflected, packet.point);
    if (!bent.is_total) weigh(children.reflected, FactorKind::reflect, bent.fresnel);
  }
  if (bent.is_total || parts == Parts::reflected) return;
  go_on(children.transmitted, bent.transmitted, crossing.beyond);
  children.transmitted.inside[lane] = crossing.inside[lane];
  weigh(children.transmitted, FactorKind::transmit, 1 - bent.fresnel);
}

/// To where the diffuse light of the lanes comes from, but for lights.
void RayTree::diffuse(const Branch& branch, const Packet& shaded, const Hits& hits,
                      std::vector<Branch>& stack, Workspace& workspace) const {
  const std::uint32_t ways = branch.bounces == 0 ? diffusion_.samples : 1;
  for (std::uint32_t way = 0; way < ways; ++way) {
    Branch child = branch;
    child.packet = shading_.diffused(shaded, hits, way, ways, workspace);
    child.from = branch.packet.hit;
    child.surfaces = branch.surfaces + 1;
    child.bounces = branch.bounces + 1;
    child.share /= static_cast<float>(ways);
    push(child, stack, workspace);
  }
}

/// The same as Tracer's, where nothing is clear.
void RayTree::mirror(const Branch& branch, const Hits& hits, unsigned lane, Children& children,
                     Workspace& workspace) const {
  const Packet& packet = branch.packet;
  const auto material = static_cast<std::uint32_t>(hits.material[lane]);
  const RenderMaterial& from = scene_.materials[material];
  if (!(from.mirror > 0) || depth_ == 0) return;
  if (branch.depth == depth_) return end(branch, lane, workspace.beyond_depth);
  const Eigen::Vector3f direction = lane_of(packet.direction, lane);
  const Eigen::Vector3f normal = lane_of(hits.normal, lane);
  Packet& to = children.reflected.packet;
  to.active[lane] = -1;
  float weight = to.throughput[lane];
  to.chain[lane] = over_mirror(workspace.gathers[packet.pixel[lane]], packet.chain[lane], from,
                               material, std::clamp(-direction.dot(normal), 0.0f, 1.0f), weight);
  to.throughput[lane] = weight;
  set_lane(to.direction, reflect(direction, normal, lane_of(hits.geometric_normal, lane)), lane);
  set_lane(to.origin, lane_of(packet.point, lane), lane);
}

void RayTree::end(const Branch& branch, unsigned lane, double& sum) {
  sum += double{branch.importance[lane]} * double{branch.packet.throughput[lane]};
}

/// Without the paths that count for too little.
void RayTree::push(Branch& child, std::vector<Branch>& stack, Workspace& workspace) const {
  Ints& active = child.packet.active;
  for (unsigned i = 0; i < lane_count; ++i) {
    if (!active[i]) continue;
    if (child.surfaces >= most_surfaces) {
      end(child, i, workspace.beyond_depth);
    } else if (child.bounces > 0) {
      if (goes_on(child, i)) continue;
    } else {
      if (child.importance[i] * child.packet.throughput[i] >= cutoff_) continue;
      end(child, i, workspace.below_cutoff);
    }
    active[i] = 0;
  }
  if (any(active)) stack.push_back(child);
}

/// A scattered path is one of many: if it weighs little among them it goes on by chance, and counts
/// for as much more (J. Arvo and D. Kirk, 1990). So paths that split at each surface stay few.
bool RayTree::goes_on(Branch& child, unsigned lane) {
  constexpr float sure = 0.25f;
  constexpr std::uint32_t of_chance = 1U << 30;
  Packet& packet = child.packet;
  const float probability = child.importance[lane] * packet.throughput[lane] / (child.share * sure);
  if (probability >= 1) return true;
  soft::Points chance;
  soft::Pattern{packet.sample[lane], soft::hashed(packet.seed[lane], of_chance + child.surfaces)}
      .shuffled()
      .put(chance, lane);
  if (!(chance.u[lane] < probability)) return false;
  packet.throughput[lane] /= probability;
  return true;
}

}  // namespace metamer::cpu
