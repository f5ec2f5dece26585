#include "common/mesh/used_vertices.h"

#include "common/mesh/normals/equal_positions.h"
#include "common/mesh/vertex.h"

namespace metamer {
namespace {

/// Moves `values` of the vertices that are kept to their new places, which are not behind the old.
template <typename T>
void keep_vertices(const std::vector<std::uint32_t>& kept, std::vector<T>& values) {
  if (values.empty()) return;
  for (std::size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
  values.resize(kept.size());
  values.shrink_to_fit();
}

}  // namespace

void keep_used_vertices(MeshFile& file) {
  std::vector<std::uint32_t> numbers(vertex_count(file), 0), kept;
  for (const Triangle& triangle : file.triangles)
    for (const std::uint32_t vertex : triangle) numbers[vertex] = 1;
  for (std::uint32_t vertex = 0; vertex < numbers.size(); ++vertex) {
    if (numbers[vertex] == 0) continue;
    numbers[vertex] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(vertex);
  }
  for (Triangle& triangle : file.triangles)
    for (std::uint32_t& vertex : triangle) vertex = numbers[vertex];
  keep_vertices(kept, file.positions);
  keep_vertices(kept, file.positions_f64);
  keep_vertices(kept, file.normals);
  keep_vertices(kept, file.uvs);
}

void join_repeated_vertices(MeshFile& file) {
  const std::size_t triangles = file.triangles.size();
  if (!file.normals.empty() || !file.uvs.empty() || triangles < 2) return;
  if (vertex_count(file) < 3 * triangles) return;
  const std::vector<std::uint32_t> same = equal_positions(file);
  if (same.empty()) return;
  for (Triangle& triangle : file.triangles)
    for (std::uint32_t& vertex : triangle) vertex = same[vertex];
  keep_used_vertices(file);
}

}  // namespace metamer
