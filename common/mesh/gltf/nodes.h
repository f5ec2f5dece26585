#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "common/mesh/gltf/document.h"

namespace metamer::gltf {

/// An affine map. Not Eigen's own, whose alignment depends on the processor that a source is
/// compiled for: renderers have another than this.
struct Placement {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& p) const { return linear * p + translation; }
  Placement operator*(const Placement& inner) const {
    return {linear * inner.linear, linear * inner.translation + translation};
  }
  bool is_identity() const { return linear.isIdentity(0) && translation.isZero(0); }
};

/// A node of the scene, where it stands.
struct PlacedNode {
  std::size_t index;   ///< In the document's nodes.
  Placement to_world;  ///< glTF's space is Metamer's: right-handed, y up, metres.
};

/// The default scene's nodes, parents before children; where no scene is named, all nodes that
/// nobody has for a child. A node that is met twice is a fault.
std::vector<PlacedNode> placed_nodes(const Document& document);

/// Without control characters, which a scene's names can't have.
std::string on_one_line(std::string name);
/// A node's name, else its mesh's, else "node_3"; on one line.
std::string name_of_node(const Document& document, std::size_t index);
/// The materials' names, else "material_3", each once: a second "red" is "red 2"; on one line.
std::vector<std::string> material_names(const Document& document);

/// Translation, rotation (a quaternion x y z w of any length) and scale, in the order that glTF
/// applies them.
Placement transform(const Eigen::Vector3d& translation, const std::array<double, 4>& rotation,
                    const Eigen::Vector3d& scale);

}  // namespace metamer::gltf
