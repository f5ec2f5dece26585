#pragma once

#include <tbb/task_arena.h>

#include <algorithm>
#include <vector>

#include "common/mesh/normals/corner_angles.h"
#include "common/mesh/normals/exact_sum.h"
#include "common/mesh/parallel.h"

namespace metamer {

/// For each vertex the sum of what `of_triangle(i)` gives its triangles, a unit vector and three
/// weights, made a direction by `direction(vertex, sum)`. `same`: vertices that count as one, by
/// the number of one of them; or empty. Each thread sums for some of the vertices, over all
/// triangles.
template <typename OfTriangle, typename Direction>
std::vector<Float3> vertex_averages(const MeshFile& mesh, const std::vector<std::uint32_t>& same,
                                    const OfTriangle& of_triangle, const Direction& direction) {
  const std::size_t count = vertex_count(mesh);
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  const std::size_t parts = std::min(4 * threads, count / 16384 + 1);
  std::vector<Float3> averages(count);
  tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t part) {
    const std::size_t first = count * part / parts, size = count * (part + 1) / parts - first;
    std::vector<ExactSum> sums(size);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      Triangle t = mesh.triangles[i];
      if (!same.empty()) t = {same[t[0]], same[t[1]], same[t[2]]};
      if (t[0] - first >= size && t[1] - first >= size && t[2] - first >= size) continue;
      const CornerAngles corners = of_triangle(i);
      for (std::size_t k = 0; k < 3; ++k)
        if (t[k] - first < size) sums[t[k] - first].add(corners.normal, corners.angles[k]);
    }
    for (std::size_t i = 0; i < size; ++i)
      averages[first + i] = direction(first + i, sums[i].value());
  });
  for_ranges(same.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (same[i] != i) averages[i] = averages[same[i]];
  });
  return averages;
}

}  // namespace metamer
