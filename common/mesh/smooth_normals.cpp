#include "common/mesh/smooth_normals.h"

#include <algorithm>

#include "common/mesh/corner_angles.h"
#include "common/mesh/equal_positions.h"
#include "common/mesh/exact_sums.h"
#include "common/mesh/parallel.h"

namespace metamer {

void smooth_normals(MeshFile& mesh) {
  const std::size_t count = vertex_count(mesh);
  mesh.normals.resize(count);
  if (std::find(mesh.normals.begin(), mesh.normals.end(), Float3{}) == mesh.normals.end()) return;

  const std::vector<std::uint32_t> same = equal_positions(mesh);
  const auto place = [&](std::size_t vertex) { return same.empty() ? vertex : same[vertex]; };
  const double step = rounding_of(mesh);
  ExactSums sums(count);
  for_ranges(mesh.triangles.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Triangle& t = mesh.triangles[i];
      const CornerAngles corners =
          corner_angles(position(mesh, t[0]), position(mesh, t[1]), position(mesh, t[2]), step);
      for (std::size_t k = 0; k < 3; ++k)
        if (corners.angles[k] > 0) sums.add(place(t[k]), corners.normal, corners.angles[k]);
    }
  });
  for_ranges(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (mesh.normals[i] == Float3{}) mesh.normals[i] = unit_or_none(sums[place(i)]);
  });
}

}  // namespace metamer
