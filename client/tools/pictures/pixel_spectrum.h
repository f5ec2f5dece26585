#pragma once

#include <vector>

#include "client/relight/factors.h"
#include "common/spectral/cie.h"

namespace metamer::client {

/// What reaches the eye from a square of pixels of a kept picture, on the mean: at every whole
/// nanometre from 360 to 830 (relight_spectral). The square is that of mean_xyz; its middle lies in
/// the picture.
std::vector<double> pixel_spectrum(const Factors& factors, const v1::SceneFactors& scene,
                                   const Observer& observer, int x, int y, int side);

}  // namespace metamer::client
