#include "common/mesh/smooth_normals.h"

#include <algorithm>

#include "common/mesh/normals/equal_positions.h"
#include "common/mesh/normals/vertex_averages.h"

namespace metamer {

void smooth_normals(MeshFile& mesh) {
  const auto none = [](const Float3& normal) { return normal == Float3{}; };
  if (!mesh.normals.empty() && std::none_of(mesh.normals.begin(), mesh.normals.end(), none)) return;
  const double step = rounding_of(mesh);
  std::vector<Float3> averages = vertex_averages(
      mesh, equal_positions(mesh),
      [&](std::size_t i) {
        const auto& [a, b, c] = mesh.triangles[i];
        return corner_angles(position(mesh, a), position(mesh, b), position(mesh, c), step);
      },
      [](std::size_t, const Double3& sum) { return unit_or_none(sum); });
  if (mesh.normals.empty())
    mesh.normals = std::move(averages);
  else
    for (std::size_t i = 0; i < averages.size(); ++i)
      if (none(mesh.normals[i])) mesh.normals[i] = averages[i];
}

}  // namespace metamer
