#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "client/tools/mesh/import_pictures.h"
#include "common/mesh/gltf/gltf_scene.h"
#include "metamer/v1/scene.pb.h"

/// The materials of a mesh file as a scene has them.
namespace metamer::client {

/// A material of a file, by three numbers a colour.
struct FileMaterial {
  std::string name;
  Double3 base_color{};  ///< Linear sRGB.
  Double3 specular{};    ///< The same, of a highlight; 0: it has none.
  double exponent = 0;   ///< n of its (N·H)^n.
  std::string remarks;   ///< What of it is left out: ", times a texture"; empty: nothing.
  std::optional<GltfMaterial> gltf = {};  ///< What it is of, for its pictures.
};

struct FileMaterials {
  std::vector<FileMaterial> materials;
  std::vector<std::string> left_out;  ///< As sentences.
};

FileMaterials materials_of(const GltfScene& scene);

/// Those of the .mtl files that an OBJ names, which lie in its folder or below it. What can't be
/// read is told among what was left out.
FileMaterials load_obj_materials(const std::filesystem::path& obj);

/// Gives a material of a scene the colours of one of a file: reflectances that are seen so under
/// D65 (reflectance_of_rgb), and a highlight by blinn_phong; of a glTF the pictures of its colours,
/// normals and alpha, where its surface `has_uvs`. Returns what is to be said of it.
std::string fill(const FileMaterial& from, bool has_uvs, ImportedPictures& pictures,
                 v1::Material& to);

}  // namespace metamer::client
