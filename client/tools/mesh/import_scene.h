#pragma once

#include "client/tools/mesh/import_pictures.h"
#include "client/tools/mesh/mesh_facts.h"
#include "metamer/v1/scene.pb.h"

/// A scene that is made of a mesh file.
namespace metamer::client {

struct ImportedScene {
  v1::Scene message;
  /// What of the file is not in the scene, and what stands for it; as sentences.
  std::vector<std::string> left_out;
  std::vector<NewFile> files;  ///< Pictures that the scene names and that have to be written.
};

/// One object for each part; the file's materials, an OBJ's by its .mtl, with reflectances that
/// look as their colours under D65 (import_materials); its first camera, or one that sees all of
/// it; the pictures of a glTF's colours, normals and alpha; its lights under D65, their luminance
/// relative to top_illuminance(), or one lamp. `scene_folder`: where the scene file will be; the
/// mesh has to lie in it or below. Errors: those of load_mesh; a mesh elsewhere.
Result<ImportedScene> import_scene(const std::filesystem::path& mesh,
                                   const std::filesystem::path& scene_folder);

/// The scene's text, with what was left out as comments before it.
std::string scene_text(const ImportedScene& scene, const std::filesystem::path& mesh);

}  // namespace metamer::client
