#include <tbb/parallel_sort.h>

#include <algorithm>
#include <atomic>
#include <boost/unordered/unordered_flat_map.hpp>
#include <cmath>
#include <numeric>

#include "common/mesh/normals/corner_angles.h"
#include "common/mesh/normals/equal_positions.h"
#include "common/mesh/normals/exact_sum.h"
#include "common/mesh/parallel.h"
#include "common/mesh/smooth_normals.h"

namespace metamer {
namespace {

constexpr std::size_t most_at_edge = 8;

/// Corners that share a normal, as a forest whose roots are the smallest (Tarjan 1975).
class SmoothCorners {
 public:
  explicit SmoothCorners(std::size_t count) : parents_(count) {
    std::iota(parents_.begin(), parents_.end(), 0u);
  }
  std::uint32_t root(std::uint32_t corner) {
    while (parents_[corner] != corner) corner = parents_[corner] = parents_[parents_[corner]];
    return corner;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parents_;
};

/// A triangle's side from one place to another, the lesser first, and its corners there.
struct Side {
  std::uint32_t low, high;
  std::uint32_t at_low, at_high;
  bool operator<(const Side& other) const {
    return std::tie(low, high) < std::tie(other.low, other.high);
  }
  bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

class Creases {
 public:
  Creases(MeshFile& mesh, double degrees)
      : mesh_(mesh),
        least_cosine_(std::cos(degrees * M_PI / 180) - 1e-6),
        corners_(mesh.triangles.size()),
        groups_(3 * mesh.triangles.size()) {
    const double step = rounding_of(mesh);
    for_ranges(corners_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto& [a, b, c] = mesh.triangles[i];
        corners_[i] = corner_angles(position(mesh, a), position(mesh, b), position(mesh, c), step);
      }
    });
  }

  void smooth() {
    std::vector<Side> sides = find_sides();
    tbb::parallel_sort(sides.begin(), sides.end());
    for (std::size_t begin = 0, end; begin < sides.size(); begin = end) {
      for (end = begin; end < sides.size() && sides[end].same_edge(sides[begin]);) ++end;
      if (end - begin <= most_at_edge) join(sides.data() + begin, sides.data() + end);
    }
    sides = {};
    split_vertices();
  }

 private:
  bool spans(std::size_t triangle) const { return corners_[triangle].normal != Double3{}; }

  bool in_one_group(std::size_t a, std::size_t b) const {
    const std::vector<std::uint32_t>& groups = mesh_.smoothing;
    return groups.empty() || (groups[a] == groups[b] && groups[a] != 0);
  }

  std::vector<Side> find_sides() const {
    const std::vector<std::uint32_t> same = equal_positions(mesh_);
    std::vector<Side> sides;
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i)
      for (std::uint32_t k = 0; spans(i) && k < 3; ++k) {
        std::uint32_t a = mesh_.triangles[i][k], b = mesh_.triangles[i][(k + 1) % 3];
        if (!same.empty()) a = same[a], b = same[b];
        Side side{.low = a, .high = b, .at_low = 3 * i + k, .at_high = 3 * i + (k + 1) % 3};
        if (b < a) side = {.low = b, .high = a, .at_low = side.at_high, .at_high = side.at_low};
        sides.push_back(side);
      }
    return sides;
  }

  /// Joins the corners of triangles that meet at an edge at no more than the angle.
  void join(const Side* begin, const Side* end) {
    for (const Side* a = begin; a != end; ++a)
      for (const Side* b = a + 1; b != end; ++b) {
        const double cosine = dot(corners_[a->at_low / 3].normal, corners_[b->at_low / 3].normal);
        if (cosine < least_cosine_ || !in_one_group(a->at_low / 3, b->at_low / 3)) continue;
        groups_.join(a->at_low, b->at_low);
        groups_.join(a->at_high, b->at_high);
      }
  }

  /// Gives each vertex the normal of its first group of corners, and further groups vertices of
  /// their own.
  void split_vertices() {
    constexpr std::uint32_t none = 0xFFFFFFFF;
    const std::vector<std::uint32_t> numbers = number_groups();
    std::vector<ExactSum> sums(groups_in_use_);
    std::vector<std::uint32_t> first(vertex_count(mesh_), none);
    boost::unordered_flat_map<std::uint64_t, std::uint32_t> others;
    std::vector<std::uint32_t> groups_of_others;
    for (std::uint32_t corner = 0; corner < numbers.size(); ++corner) {
      if (!spans(corner / 3)) continue;
      const CornerAngles& angles = corners_[corner / 3];
      const std::uint32_t group = numbers[corner];
      sums[group].add(angles.normal, angles.angles[corner % 3]);
      std::uint32_t& vertex = mesh_.triangles[corner / 3][corner % 3];
      if (first[vertex] == none) first[vertex] = group;
      if (first[vertex] == group) continue;
      const auto next = static_cast<std::uint32_t>(vertex_count(mesh_));
      const auto [found, added] = others.try_emplace((std::uint64_t{vertex} << 32) | group, next);
      if (added) {
        repeat(vertex);
        groups_of_others.push_back(group);
      }
      vertex = found->second;
    }
    for (const std::uint32_t group : first)
      mesh_.normals.push_back(group == none ? Float3{} : unit_or_none(sums[group].value()));
    for (const std::uint32_t group : groups_of_others)
      mesh_.normals.push_back(unit_or_none(sums[group].value()));
  }

  std::vector<std::uint32_t> number_groups() {
    std::vector<std::uint32_t> numbers(3 * corners_.size());
    for (std::uint32_t corner = 0; corner < numbers.size(); ++corner) {
      const std::uint32_t root = groups_.root(corner);  // Numbered before: it is the smallest.
      numbers[corner] = root == corner ? groups_in_use_++ : numbers[root];
    }
    return numbers;
  }

  void repeat(std::uint32_t vertex) {
    const auto add = [&](auto& values) {
      if (values.empty()) return;
      const auto value = values[vertex];
      values.push_back(value);
    };
    add(mesh_.positions);
    add(mesh_.positions_f64);
    add(mesh_.uvs);
  }

  MeshFile& mesh_;
  double least_cosine_;
  std::vector<CornerAngles> corners_;  ///< Of each triangle.
  SmoothCorners groups_;
  std::uint32_t groups_in_use_ = 0;
};

/// Whether no two triangles at a vertex can be more than the angle apart, as each is within half of
/// it from the vertex's normal.
bool has_no_crease(const MeshFile& mesh, double degrees) {
  const double least_cosine = std::cos(degrees / 2 * M_PI / 180);
  const double step = rounding_of(mesh);
  std::atomic<bool> none = true;
  for_ranges(mesh.triangles.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && none; ++i) {
      const Triangle& t = mesh.triangles[i];
      const Double3 normal =
          corner_angles(position(mesh, t[0]), position(mesh, t[1]), position(mesh, t[2]), step)
              .normal;
      if (normal == Double3{}) continue;
      for (const std::uint32_t vertex : t) {
        const Float3& n = mesh.normals[vertex];
        if (!(dot(normal, {n[0], n[1], n[2]}) >= least_cosine)) none = false;
      }
    }
  });
  return none;
}

}  // namespace

void creased_normals(MeshFile& mesh, double degrees) {
  if (mesh.smoothing.empty()) {
    // Most meshes are round: that takes a tenth of the time to find out.
    smooth_normals(mesh);
    if (has_no_crease(mesh, degrees)) return;
    mesh.normals.clear();
  }
  Creases(mesh, degrees).smooth();
}

}  // namespace metamer
