#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "client/tools/spectra/worded_spectra.h"
#include "metamer/v1/scene.pb.h"

/// The lights and paints of a scene as spectra by themselves.
namespace metamer::client {

struct SceneSpectra {
  std::vector<WordedSpectrum>
      spectra;                    ///< Labelled by the lights or materials that have them; without
                                  ///< a word where they are written in the scene alone.
  std::vector<Problem> problems;  ///< Of those that can't be had, with their fields.
};

/// Those of lights and of materials (diffuse and specular; not their n and k), in the scene's
/// order, each once. `folder` is where its files are named from. Reads files.
SceneSpectra scene_spectra(const v1::Scene& scene, const std::filesystem::path& folder);

}  // namespace metamer::client
