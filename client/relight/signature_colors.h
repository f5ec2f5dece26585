#pragma once

#include <vector>

#include "common/spectral/cie.h"
#include "metamer/v1/factors.pb.h"

namespace metamer::client {

/// X Y Z and nothing: four lanes.
struct alignas(16) Color {
  float value[4];
};

/// What an observer sees of each signature of `tables`, by its number: the chain's product times
/// the factor times the light of `scene`, in the scene's bands (common/transport/scene_bands). From
/// any thread.
std::vector<Color> signature_colors(const v1::TileFactors& tables, const v1::SceneFactors& scene,
                                    const Observer& observer);

}  // namespace metamer::client
