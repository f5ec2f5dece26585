#pragma once

#include <string>
#include <vector>

#include "common/scene/findings.h"
#include "common/scene/validate.h"
#include "common/spectral/fluorescence.h"

namespace metamer {

/// What a material's fluorescence stands for, with what is worth a notice: a sentence each. The
/// message is sound (check_fluorescence). Errors as load_spectrum's and read_bispectral_file's.
struct NotedFluorescence {
  Fluorescence fluorescence;
  std::vector<std::string> notes = {};
};
Result<NotedFluorescence> load_fluorescence(const v1::Fluorescence& message,
                                            const std::string& field, const AssetReader& assets);

/// Adds what is wrong with the fluorescences of a scene that validate_scene has nothing against:
/// their files, and with their materials' diffuse the law of energy. What is wrong with their
/// spectra and with diffuse stays unsaid.
void check_fluorescences(const v1::Scene& scene, const AssetReader& assets, Findings& findings);

}  // namespace metamer
