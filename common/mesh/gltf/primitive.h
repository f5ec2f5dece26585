#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "common/mesh/gltf/accessor.h"
#include "common/mesh/gltf/nodes.h"

namespace metamer::gltf {

/// Triangles of one material (glTF 2.0, 3.7.2), with what they are read from.
struct Primitive {
  Accessor positions;
  std::optional<Accessor> normals = {}, uvs = {}, indices = {};
  struct Target {
    std::optional<Accessor> positions, normals;
  };
  std::vector<Target> targets = {};  ///< Of morphing; of its mesh's `weights`, or its node's.
  enum class Mode { triangles = 4, strip = 5, fan = 6 } mode = Mode::triangles;
  std::string material = {};  ///< Empty: none.

  std::size_t corners() const { return indices ? indices->size() : positions.size(); }
  std::size_t triangles() const {
    const std::size_t n = corners();
    return mode == Mode::triangles ? n / 3 : n < 3 ? 0 : n - 2;
  }
};

/// The primitives of a mesh that are triangles; `skipped` counts the points and lines of others.
std::vector<Primitive> open_primitives(Document& document, const Value& mesh,
                                       const std::vector<std::string>& material_names,
                                       std::uint64_t& skipped);

/// Where and how a primitive is drawn.
struct Drawn {
  Placement to_world;
  std::vector<double> weights;  ///< Of the targets, as many.
};

/// Appends a primitive's triangles, placed and morphed; `f64`: to the finer positions. Normals are
/// 0 where it has none. Problems: a vertex that is not a position, an index beyond them.
Result<void> append(const Primitive& primitive, const Drawn& drawn, bool f64, MeshFile& to);

/// The box around its vertices, placed.
Eigen::AlignedBox3d box_of(const Primitive& primitive, const Drawn& drawn);

}  // namespace metamer::gltf
