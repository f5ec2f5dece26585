#pragma once

#include "client/relight/signature_colors.h"

namespace metamer::client {

/// What signature_colors says, by three numbers in place of spectra: the method `rgb`. Fresnel
/// terms become numbers as a whole, too.
std::vector<Color> rgb_colors(const v1::TileFactors& tables, const v1::SceneFactors& scene,
                              const Observer& observer);

}  // namespace metamer::client
