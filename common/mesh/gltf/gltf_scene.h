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

/// An image that a material names: a file, or bytes within the glTF's own.
struct GltfImage {
  std::string name = {};   ///< May be empty.
  std::string file = {};   ///< Relative to the folder that the glTF's name is relative to.
  Bytes bytes = {};        ///< Where it is no file.
  std::string fault = {};  ///< Why it is neither.
};

/// One that lies on a surface: at rotation (scale uv) + offset, where v rises from its bottom.
struct GltfPicture {
  enum class Wrap { repeat, clamp, mirror };
  std::size_t image;  ///< Index into GltfScene::images.
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  std::array<double, 2> scale = {1, 1}, offset = {0, 0};
  double rotation = 0;               ///< Degrees, from u towards v.
  double strength = 1;               ///< Of normals.
  std::uint64_t coordinate_set = 0;  ///< TEXCOORD_n; a MeshFile has those of 0.
};

struct GltfMaterial {
  std::string name;
  Double3 base_color;  ///< Linear sRGB, 0..1.
  bool is_textured, is_metallic;
  std::optional<GltfPicture> base_color_picture = {}, normal_picture = {};
  double base_alpha = 1;
  std::string alpha_mode = {};  ///< "MASK", "BLEND", "OPAQUE" or none of them.
  double alpha_cutoff = 0.5;    ///< Of MASK.
  /// What else counts of it: "emissiveFactor", "KHR_materials_transmission", each once.
  std::vector<std::string> left_out = {};
};

struct GltfScene {
  std::vector<GltfCamera> cameras;  ///< Perspective ones, in the scene's order.
  std::vector<GltfLight> lights;
  std::vector<GltfMaterial> materials;
  std::vector<GltfImage> images;      ///< That the materials' pictures name.
  std::vector<std::string> left_out;  ///< As sentences.
};

/// Errors: those of a document that is not sound.
Result<GltfScene> read_gltf_scene(const Bytes& bytes, const std::string& name,
                                  const MeshBytes& files);

}  // namespace metamer
