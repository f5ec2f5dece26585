#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "common/mesh/gltf/document.h"

namespace metamer::gltf {

/// A node of the scene, where it stands.
struct PlacedNode {
  std::size_t index;         ///< In the document's nodes.
  Eigen::Affine3d to_world;  ///< glTF's space is Metamer's: right-handed, y up, metres.
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

/// Translation, rotation (x y z w, any length) and scale, in the order that glTF applies them.
Eigen::Affine3d transform(const Eigen::Vector3d& translation, const Eigen::Vector4d& rotation,
                          const Eigen::Vector3d& scale);

}  // namespace metamer::gltf
