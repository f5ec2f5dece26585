#pragma once

#include <google/protobuf/field_mask.pb.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/problem.h"
#include "metamer/v1/scene.pb.h"

namespace metamer::client {

/// A part of a scene that something else took the place of: a problem there is not the scene's.
struct Replaced {
  std::string field;  ///< "settings.spp"
  std::string by;     ///< "--spp", "look \"shop\""
  /// Of a field that names a file: it lies there, and not in the scene's folder.
  std::filesystem::path file = {};
  /// Where in the scene's text that stands: "look[1].light[0].spectrum"; empty: it is not in there.
  std::string from = {};
};

/// Other light for a scene.
struct LightChange {
  v1::LookLight light;
  std::string by;
  std::filesystem::path file = {};  ///< Where spectrum.file lies; empty: in the scene's folder.
  std::string from = {};            ///< As Replaced has it: "look[1].light[0]".
};

/// Other paint for a scene.
struct MaterialChange {
  v1::LookMaterial material;
  std::string by;
  std::string from = {};  ///< As Replaced has it: "look[1].material[0]".
};

/// A set of changes to a scene: what options say, what a look of the scene says (look_named), or
/// what a window was told. A later change of one thing counts.
struct Look {
  v1::Settings settings;             ///< Values for the scene's settings,
  google::protobuf::FieldMask mask;  ///< and which of them count: "spp", "method.point.step".
  std::vector<LightChange> lights;   ///< In this order.
  std::vector<MaterialChange> materials;
  std::optional<v1::Camera> camera;
  std::vector<Replaced> replaced;  ///< What is to be said of the settings and the camera.

  /// Says that settings.<path> counts, and by what it is set.
  void set(const std::string& path, const std::string& by) {
    mask.add_paths(path);
    replaced.push_back({"settings." + path, by});
  }
};

/// Puts the look's values in the place of the scene's. A message that the mask names as a whole is
/// merged; a list is replaced; a method takes the place of a goal, and a goal that of a method.
/// Whether the values make sense is validate_scene's business. Returns all that was replaced.
/// Error, at the change's place where that has one: a light or a material that is not there, with
/// "did you mean"; the scene may be changed in part then.
Result<std::vector<Replaced>> apply(const Look& look, v1::Scene& scene);

/// What the scene's look of that name changes. A camera and a spectrum are taken whole, of a
/// development what it says. Whether the look makes sense is validate_looks' business. Error: there
/// is none of that name; with "did you mean" and the names that there are.
Result<Look> look_named(const v1::Scene& scene, const std::string& name);

/// What replaced the field, or one that it lies in, last; null when it is the scene's own.
const Replaced* find_replaced(const std::vector<Replaced>& replaced, const std::string& field);
/// By what; empty when it is the scene's own.
std::string replaced_by(const std::vector<Replaced>& replaced, const std::string& field);

}  // namespace metamer::client
