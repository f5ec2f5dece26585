#pragma once

#include <span>
#include <vector>

#include "common/mesh/mesh_file.h"

namespace metamer {

/// The triangles of a polygon by the numbers of its corners, as many as corners less two, with the
/// polygon's orientation: convex ones and quadrilaterals from one corner, others by cutting ears
/// (Meisters 1975) in the plane of Newell's normal. Above `most_ears` corners, and where corners
/// span no area, a fan from the first. `to` is overwritten.
void triangulate(std::span<const Double3> corners, std::vector<Triangle>& to);

inline constexpr std::size_t most_ears = 1000;  ///< Cutting takes the square of them.

/// Makes triangles of one face after the other. For one thread.
class FaceSplitter {
 public:
  explicit FaceSplitter(const MeshFile& vertices) : vertices_(vertices) {}

  /// The triangles of a face by its vertices, at most two less, from `to` on; returns their end.
  /// Those that name a vertex twice are left out.
  Triangle* operator()(std::span<const std::uint32_t> face, Triangle* to);

 private:
  const MeshFile& vertices_;
  std::vector<Double3> corners_;
  std::vector<Triangle> triangles_;
};

}  // namespace metamer
