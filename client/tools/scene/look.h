#pragma once

#include <google/protobuf/field_mask.pb.h>

#include <filesystem>
#include <string>
#include <vector>

#include "common/problem.h"
#include "metamer/v1/scene.pb.h"

namespace metamer::client {

/// A part of a scene that something else took the place of: a problem there is not the scene's.
struct Replaced {
  std::string field;  ///< "settings.spp"
  std::string by;     ///< "--spp"
  /// Of a field that names a file: it lies there, and not in the scene's folder.
  std::filesystem::path file = {};
};

/// Other light for a scene.
struct LightChange {
  std::string light;  ///< The light's name; "*": all of them.
  v1::Spectrum spectrum;
  std::string by;
  std::filesystem::path file = {};  ///< Where spectrum.file lies; empty: in the scene's folder.
};

/// A set of changes to a scene.
struct Look {
  v1::Settings settings;             ///< Values for the scene's settings,
  google::protobuf::FieldMask mask;  ///< and which of them count: "spp", "method.point.step".
  std::vector<LightChange> lights;   ///< In this order.
  std::vector<Replaced> replaced;    ///< What is to be said of the settings.

  /// Says that settings.<path> counts, and by what it is set.
  void set(const std::string& path, const std::string& by) {
    mask.add_paths(path);
    replaced.push_back({"settings." + path, by});
  }
};

/// Puts the look's values in the place of the scene's. A message that the mask names as a whole is
/// merged; a list is replaced; a method takes the place of a goal, and a goal that of a method.
/// Whether the values make sense is validate_scene's business. Returns all that was replaced.
/// Error: a light that is not there, with "did you mean"; the scene may be changed in part then.
Result<std::vector<Replaced>> apply(const Look& look, v1::Scene& scene);

/// By what the field, or one that it lies in, was replaced; empty when it is the scene's own.
std::string replaced_by(const std::vector<Replaced>& replaced, const std::string& field);

}  // namespace metamer::client
