#pragma once

#include <optional>

#include "client/relight/factors.h"
#include "common/color/xyz.h"
#include "common/image/image.h"
#include "common/spectral/cie.h"

/// The renderer's second half by itself: what light and paint make of a picture's factors. The
/// answer is that of the method `exact`, to the rounding of f32.
namespace metamer::client {

/// The observer that a picture is seen by: the scene's, where it has one; else the plan's.
Observer observer_of(const v1::Plan& plan, const v1::SceneFactors& scene);

/// X Y Z of each pixel. `scene` has the lights and materials of `factors.scene`, with spectra of
/// its own choice.
Image relight(const Factors& factors, const v1::SceneFactors& scene, const Observer& observer);

/// The light of each pixel in bands at `wavelengths`, a channel each, named by its nm: the lights'
/// band means times the reflectances there.
Image relight_spectral(const Factors& factors, const v1::SceneFactors& scene,
                       const Observer& observer, const Wavelengths& wavelengths);

/// How much of a light's luminance bands at these wavelengths show: 1 is all of it, and of nothing.
double seen_share(const v1::SceneFactors::Light& light, const Observer& observer,
                  const Wavelengths& wavelengths);

/// X Y Z of the dominant light at Y = 1; empty where the observer sees nothing of it.
std::optional<Xyz> source_white(const v1::SceneFactors& scene, const Observer& observer);

}  // namespace metamer::client
