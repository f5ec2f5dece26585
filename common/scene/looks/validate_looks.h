#pragma once

#include <vector>

#include "common/problem.h"
#include "metamer/v1/scene.pb.h"

namespace metamer {

/// Everything wrong with a scene's looks that can be seen without opening a file, each with its
/// field path ("look[1].light[0].name"): names that are missing, too long or given twice; lights
/// and materials that the scene has not (with "did you mean") or that a look changes twice; changes
/// that change nothing; and what validate_scene says of spectra, luminances, cameras and
/// developments. Clients run it beside validate_scene; servers have no use for looks. Empty: they
/// are sound.
std::vector<Problem> validate_looks(const v1::Scene& scene);

}  // namespace metamer
