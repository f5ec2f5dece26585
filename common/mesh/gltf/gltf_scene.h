#pragma once

#include "common/mesh/mesh_file.h"

/// What a glTF says beside its triangles, as far as a spectral scene can take it.
namespace metamer {

struct GltfCamera {
  std::string name;
  Double3 eye, forward, up;  ///< Unit directions.
  double vertical_fov;       ///< Degrees.
};

/// KHR_lights_punctual.
struct GltfLight {
  enum class Kind { point, directional, spot };
  std::string name;
  Kind kind;
  Double3 position, direction;    ///< The way its light travels; unit.
  double intensity;               ///< Candela of points and spots, lux of directional lights.
  double inner_cone, outer_cone;  ///< Degrees, of a spot.
  bool is_colored;
};

struct GltfMaterial {
  std::string name;
  Double3 base_color;  ///< Linear sRGB, 0..1.
  bool is_textured, is_metallic;
  /// What else counts of it: "emissiveFactor", "KHR_materials_transmission", each once.
  std::vector<std::string> left_out = {};
};

struct GltfScene {
  std::vector<GltfCamera> cameras;  ///< Perspective ones, in the scene's order.
  std::vector<GltfLight> lights;
  std::vector<GltfMaterial> materials;
  std::vector<std::string> left_out;  ///< As sentences.
};

/// Errors: those of a document that is not sound.
Result<GltfScene> read_gltf_scene(const Bytes& bytes, const std::string& name,
                                  const MeshBytes& files);

}  // namespace metamer
