#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/relight/factors.h"
#include "metamer/v1/scene.pb.h"

namespace metamer::client {

/// The material that the eye meets in a pixel of a kept picture: of those whose spectra the first
/// surfaces of its light paths have, the one with the most weight. Nothing: no light comes from
/// there, or only such that no spectrum of a material has changed. The pixel lies in the picture.
std::optional<std::string> pixel_material(const Factors& factors, int x, int y);

/// The objects of a scene that have a material, as a probe names them: one without a name by its
/// place, "object[2]".
std::vector<std::string> objects_of(const v1::Scene& scene, const std::string& material);

}  // namespace metamer::client
