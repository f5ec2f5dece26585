#include "server/cpu/media.h"

#include <algorithm>
#include <map>

#include "server/cpu/shared_source.h"
#include "server/scene/bundles.h"
#include "server/scene/media.h"

namespace metamer::cpu {
namespace {

bool is_one(const Spectrum& n) {
  return std::all_of(n.values.begin(), n.values.end(), [](double value) { return value == 1; });
}

const RenderMedium& air() {
  static const RenderMedium medium;
  return medium;
}

void copy_lane(Vectors& to, const Vectors& from, unsigned lane) {
  to.x[lane] = from.x[lane];
  to.y[lane] = from.y[lane];
  to.z[lane] = from.z[lane];
}

/// What was hit in a lane, but for where.
void copy_surface(Hits& to, const Hits& from, unsigned lane) {
  to.material[lane] = from.material[lane];
  to.object[lane] = from.object[lane];
  to.primitive[lane] = from.primitive[lane];
  to.u[lane] = from.u[lane];
  to.v[lane] = from.v[lane];
  to.interpolated[lane] = from.interpolated[lane];
  to.behind[lane] = from.behind[lane];
  to.inverted[lane] = from.inverted[lane];
  copy_lane(to.geometric_normal, from.geometric_normal, lane);
  copy_lane(to.normal, from.normal, lane);
  copy_lane(to.tangent, from.tangent, lane);
}

}  // namespace

Media::Media(const RenderScene& scene, const EmbreeScene& geometry, const Cutouts& cutouts)
    : geometry_(geometry),
      cutouts_(cutouts),
      bundles_(static_cast<std::uint32_t>(scene.windows.size())) {
  rank(scene);
  find_sides(scene);
  find_eye(scene);
}

/// Only media of objects: find_interfaces has seen to it that they are few.
void Media::rank(const RenderScene& scene) {
  std::vector<std::uint32_t> used;
  for (const RenderInterface& one : scene.interfaces)
    if (one.rare == 0 || one.dense == 0) used.push_back(std::max(one.rare, one.dense));
  std::sort(used.begin(), used.end(), [&](std::uint32_t a, std::uint32_t b) {
    const RenderMedium &one = scene.media[a], &other = scene.media[b];
    return one.priority != other.priority ? one.priority < other.priority
                                          : one.material > other.material;
  });
  used.insert(used.begin(), 0);

  std::map<std::uint32_t, std::uint8_t> rank_of;
  for (const std::uint32_t number : used) {
    rank_of[number] = static_cast<std::uint8_t>(of_.size());
    const RenderMedium& medium = scene.media.empty() ? air() : scene.media[number];
    const bool absorbing = medium.optical_depth > 0;
    of_.push_back({&medium,
                   absorbing ? static_cast<float>(medium.optical_depth / medium.thickness) : 0.0f,
                   static_cast<float>(medium.weakest)});
  }
  for (const RenderObject& object : scene.objects)
    ranks_.push_back(rank_of.at(scene.materials[object.material].medium));

  interfaces_.resize(of_.size() * of_.size());
  for (std::uint32_t i = 0; i < scene.interfaces.size(); ++i) {
    const RenderInterface& one = scene.interfaces[i];
    if (is_one(scene.constants[one.constants].n)) continue;
    const std::uint8_t rare = rank_of.at(one.rare), dense = rank_of.at(one.dense);
    const double n = scene.media[one.dense].index / scene.media[one.rare].index;
    Interface in{i, static_cast<float>(1 / n), {}, true}, out{i, static_cast<float>(n), {}, false};
    if (scene.media[one.rare].dispersion || scene.media[one.dense].dispersion)
      for (const Spectrum& window : scene.windows) {
        const double own = index_in(scene, scene.media[one.dense], window) /
                           index_in(scene, scene.media[one.rare], window);
        in.ratios.push_back(static_cast<float>(1 / own));
        out.ratios.push_back(static_cast<float>(own));
      }
    interfaces_[rare * of_.size() + dense] = std::move(in);
    interfaces_[dense * of_.size() + rare] = std::move(out);
  }
}

/// An instance's normals are turned as those of its mesh; what was placed is turned by its map.
void Media::find_sides(const RenderScene& scene) {
  inwards_.resize(scene.objects.size());
  std::map<std::uint32_t, bool> known;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const RenderObject& object = scene.objects[i];
    if (ranks_[i] == 0 || object.shape == RenderObject::Shape::sphere) continue;
    const auto [mesh, is_new] = known.try_emplace(object.mesh);
    if (is_new) mesh->second = is_turned_inwards(scene.meshes[object.mesh]);
    const bool mirrored =
        !geometry_.is_instance(static_cast<int>(i)) && object.to_world.linear().determinant() < 0;
    inwards_[i] = mesh->second != mirrored;
  }
}

void Media::find_eye(const RenderScene& scene) {
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (ranks_[i] == 0) continue;
    for (int n = std::abs(windings(scene, scene.objects[i], scene.camera.eye)); n > 0; --n)
      of_eye_.enter(ranks_[i]);
  }
}

void Media::change(int object, bool enters, unsigned lane, Crossing& crossing) const {
  const std::uint8_t rank = ranks_[static_cast<std::size_t>(object)];
  if (!enters)
    crossing.inside[lane].leave(rank);
  else if (!crossing.inside[lane].enter(rank))
    crossing.lost[lane] = -1;
}

Ints Media::passable(const Packet& at, const Hits& hits) const {
  Ints lanes{};
  for (unsigned i = 0; i < lane_count; ++i)
    if (at.active[i] &&
        (is_clear(hits.object[i]) || (cutouts_.is_needed() && cutouts_.share(at, hits, i) < 1)))
      lanes[i] = -1;
  return lanes;
}

/// Takes what a lane has met beside the surface in `hits` into account. False: the lane ends there.
bool Media::meet(const Packet& at, const Hits& met, unsigned lane, Hits& hits,
                 Crossing& crossing) const {
  const bool nothing_yet = crossing.layer[lane] == 0 && !is_clear(hits.object[lane]);
  if (is_clear(met.object[lane])) {
    if (nothing_yet) copy_surface(hits, met, lane);
    return true;
  }
  const float share = cutouts_.is_needed() ? cutouts_.share(at, met, lane) : 1;
  if (share == 0 || (share < 1 && crossing.layer[lane] > 0)) return true;
  copy_surface(hits, met, lane);
  crossing.layer[lane] = share < 1 ? share : 0;
  return share < 1;
}

Media::Crossing Media::cross(const Packet& at, Hits& hits, Ints lanes,
                             const MediaStacks& inside) const {
  const Floats lift = shared::lift_off(at.hit, hits.distance);
  const Vectors normal = hits.geometric_normal, before = at.hit + normal * lift;
  Crossing crossing;
  crossing.beyond = at.hit - normal * lift;
  crossing.inside = inside;
  crossing.passed = lanes;
  Passed passed;
  std::array<std::vector<std::pair<int, bool>>, lane_count>
      sides;  // objects, and whether from behind
  const auto pass = [&](unsigned lane, const Hits& met) {
    passed.add(lane, met.object[lane], met.primitive[lane]);
    const std::pair<int, bool> side{met.object[lane], met.behind[lane] != 0};
    // An edge between two triangles is passed once.
    if (!is_clear(side.first) ||
        std::find(sides[lane].begin(), sides[lane].end(), side) != sides[lane].end())
      return;
    sides[lane].push_back(side);
  };
  for (unsigned i = 0; i < lane_count; ++i) {
    if (!lanes[i]) continue;
    pass(i, hits);
    if (!is_clear(hits.object[i])) crossing.layer[i] = cutouts_.share(at, hits, i);
  }

  // Look for what lies between the two sides of the surface, where the ray goes on.
  const Vectors down = normal * metamer::broadcast(-1);
  Ints left = lanes;
  for (std::size_t n = 1; n < Passed::most && any(left); ++n) {
    const Hits met = geometry_.intersect_others(before, down, lift + lift, left, passed);
    left = met.hit;
    for (unsigned i = 0; i < lane_count; ++i) {
      if (!left[i]) continue;
      if (meet(at, met, i, hits, crossing))
        pass(i, met);
      else
        left[i] = crossing.passed[i] = 0;
    }
  }

  // Rounding says which of them comes first: go into all before any is left.
  for (unsigned i = 0; i < lane_count; ++i) {
    if (!crossing.passed[i]) continue;
    for (const bool front : {true, false})
      for (const auto& [object, behind] : sides[i])
        if (is_front(object, behind) == front) change(object, front, i, crossing);
  }
  return crossing;
}

}  // namespace metamer::cpu
