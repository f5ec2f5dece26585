#include "server/scene/media.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "common/scene/absorption_table.h"
#include "common/scene/limits.h"
#include "server/scene/bundles.h"
#include "server/scene/placement.h"

namespace metamer {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// n of one by that of the other, at the samples of both and at each nm between: the quotient of
/// two lines is none.
OpticalConstants relative(const Spectrum& dense, const Spectrum& rare) {
  std::set<double> nm(dense.nm.begin(), dense.nm.end());
  nm.insert(rare.nm.begin(), rare.nm.end());
  for (double at = std::ceil(*nm.begin()); at < *nm.rbegin() && at <= observer_to_nm; ++at)
    if (at >= observer_from_nm) nm.insert(at);
  OpticalConstants made{{{nm.begin(), nm.end()}, {}}, {}};
  made.n.values = resample(dense, made.n.nm, Outside::hold).values;
  const std::vector<double> below = resample(rare, made.n.nm, Outside::hold).values;
  for (std::size_t i = 0; i < below.size(); ++i) made.n.values[i] /= below[i];
  return made;
}

Eigen::AlignedBox3d world_box(const RenderScene& scene, const RenderObject& object) {
  Eigen::AlignedBox3d box(Eigen::Vector3d::Constant(-1), Eigen::Vector3d::Constant(1));
  if (object.shape == RenderObject::Shape::mesh) box = box_of(scene.meshes[object.mesh].positions);
  if (box.isEmpty()) return box;
  Eigen::AlignedBox3d placed = box.transformed(object.to_world);
  // What touches within f32 touches.
  const double slack = 1e-5 * placed.sizes().norm();
  placed.min().array() -= slack;
  placed.max().array() += slack;
  return placed;
}

/// The pairs of media that may touch: whose boxes about all of their objects do.
std::set<Pair> touching(const RenderScene& scene, const RenderScene& placed) {
  std::map<std::uint32_t, Eigen::AlignedBox3d> boxes;
  for (const RenderObject& object : placed.objects)
    if (const std::uint32_t medium = scene.materials[object.material].medium; medium > 0)
      boxes[medium].extend(world_box(placed, object));
  std::set<Pair> pairs;
  for (auto one = boxes.begin(); one != boxes.end(); ++one) {
    pairs.insert({0, one->first});
    for (auto other = std::next(one); other != boxes.end(); ++other)
      if (one->second.intersects(other->second)) pairs.insert({one->first, other->first});
  }
  return pairs;
}

std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {
  std::uint64_t z = a * 0x9e3779b97f4a7c15 + std::rotl(b, 31) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 30)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

std::uint64_t place_hash(const Double3& at) {
  std::uint64_t hash = 0;
  for (const double x : at) hash = mixed(hash, std::bit_cast<std::uint64_t>(x + 0.0));  // no −0
  return hash;
}

/// To its plane where the point lies above it, else to the nearest of its sides.
double distance_to_triangle(const std::array<Eigen::Vector3d, 3>& p, const Eigen::Vector3d& point) {
  const Eigen::Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
  bool above = normal.squaredNorm() > 0;
  double nearest = INFINITY;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d side = p[(i + 1) % 3] - p[i], way = point - p[i];
    above = above && normal.dot(side.cross(way)) >= 0;
    const double along = std::clamp(way.dot(side) / std::max(side.squaredNorm(), 1e-300), 0.0, 1.0);
    nearest = std::min(nearest, (way - along * side).norm());
  }
  return above ? std::abs(normal.normalized().dot(point - p[0])) : nearest;
}

}  // namespace

double index_at_d_line(const Spectrum& n) {
  return resample(n, {d_line_nm}, Outside::hold).values.front();
}

std::uint32_t add_medium(RenderMedium medium, RenderScene& scene) {
  if (scene.media.empty()) scene.media.emplace_back();
  const Spectrum& transmittance = scene.properties[medium.transmittance];
  medium.optical_depth = optical_depth(transmittance);
  if (medium.optical_depth > 0) {
    const std::vector<double> depths = relative_depth(transmittance, transmittance.nm);
    medium.weakest = *std::min_element(depths.begin(), depths.end());
  }
  scene.media.push_back(medium);
  return static_cast<std::uint32_t>(scene.media.size() - 1);
}

std::optional<Problem> find_interfaces(RenderScene& scene, const RenderScene& placed) {
  scene.interfaces.clear();
  scene.windows.clear();
  if (scene.media.empty()) return {};
  const std::set<Pair> pairs = touching(scene, placed);
  if (pairs.size() > limits::max_interfaces)
    return Problem{
        .field = "material[" + std::to_string(scene.media[1].material) + "].transmission",
        .file = {},
        .message = "clear materials touch in " + std::to_string(pairs.size()) +
                   " pairs, each one's with air among them; at most " +
                   std::to_string(limits::max_interfaces) + " are allowed"};
  const Spectrum air{{d_line_nm}, {1}};
  const auto n_of = [&](std::uint32_t medium) -> const Spectrum& {
    return medium == 0 ? air
                       : scene.constants[scene.materials[scene.media[medium].material].constants].n;
  };
  for (const auto& [one, other] : pairs) {
    RenderInterface made{one, other, 0};
    if (scene.media[one].index > scene.media[other].index) std::swap(made.rare, made.dense);
    const RenderMaterial& dense = scene.materials[scene.media[made.dense].material];
    if (made.rare == 0) {
      made.constants = dense.constants;
    } else {
      OpticalConstants constants = relative(n_of(made.dense), n_of(made.rare));
      made.constants = static_cast<std::uint32_t>(scene.constants.size());
      scene.constants.push_back(std::move(constants));
      const std::uint32_t named = made.dense != 0 ? made.dense : made.rare;
      scene.constants_fields.push_back("material[" + std::to_string(scene.media[named].material) +
                                       "].fresnel");
    }
    scene.interfaces.push_back(made);
  }
  choose_windows(scene);
  return {};
}

bool is_closed(const RenderScene& scene, const RenderObject& object) {
  if (object.shape == RenderObject::Shape::sphere) return true;
  const TriangleMesh& mesh = scene.meshes[object.mesh];
  // An edge and the same the other way cancel each other, whatever they hash to.
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::array<std::uint64_t, 3> corner;
    for (std::size_t j = 0; j < 3; ++j)
      corner[j] = place_hash(mesh.positions[mesh.triangles[i][j]]);
    for (std::size_t j = 0; j < 3; ++j) {
      const std::uint64_t from = corner[j], to = corner[(j + 1) % 3];
      if (from < to) sum += mixed(from, to);
      if (from > to) sum -= mixed(to, from);
    }
  }
  return sum == 0;
}

bool is_turned_inwards(const TriangleMesh& mesh) {
  const Eigen::AlignedBox3d box = box_of(mesh.positions);
  if (box.isEmpty()) return false;
  double volume = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::array<Eigen::Vector3d, 3> p;
    for (std::size_t j = 0; j < 3; ++j)
      p[j] = to_vector(mesh.positions[mesh.triangles[i][j]]) - box.center();
    volume += p[0].dot(p[1].cross(p[2]));
  }
  return volume < 0;
}

int windings(const RenderScene& scene, const RenderObject& object, const Eigen::Vector3d& point) {
  const Eigen::Vector3d own = object.to_world.inverse() * point;
  if (object.shape == RenderObject::Shape::sphere) return own.norm() < 1;
  const TriangleMesh& mesh = scene.meshes[object.mesh];
  if (!box_of(mesh.positions).contains(own)) return 0;
  double angle = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::array<Eigen::Vector3d, 3> p;
    std::array<double, 3> r;
    for (std::size_t j = 0; j < 3; ++j) {
      p[j] = to_vector(mesh.positions[mesh.triangles[i][j]]) - own;
      r[j] = p[j].norm();
    }
    angle += 2 * std::atan2(p[0].dot(p[1].cross(p[2])), r[0] * r[1] * r[2] + p[0].dot(p[1]) * r[2] +
                                                            p[1].dot(p[2]) * r[0] +
                                                            p[2].dot(p[0]) * r[1]);
  }
  return static_cast<int>(std::lround(angle / (4 * std::numbers::pi)));
}

bool is_near(const RenderScene& scene, const RenderObject& object, const Eigen::Vector3d& point,
             double reach) {
  if (object.shape == RenderObject::Shape::sphere) {
    const double shortest = object.to_world.linear().colwise().norm().minCoeff();
    return std::abs((object.to_world.inverse() * point).norm() - 1) * shortest <= reach;
  }
  const TriangleMesh& mesh = scene.meshes[object.mesh];
  const Eigen::AlignedBox3d box = box_of(mesh.positions).transformed(object.to_world);
  if (box.isEmpty() || box.exteriorDistance(point) > reach) return false;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::array<Eigen::Vector3d, 3> p;
    for (std::size_t j = 0; j < 3; ++j)
      p[j] = object.to_world * to_vector(mesh.positions[mesh.triangles[i][j]]);
    if (distance_to_triangle(p, point) <= reach) return true;
  }
  return false;
}

}  // namespace metamer
