#pragma once

#include <optional>
#include <span>
#include <vector>

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

/// The same under each of several scenes, bit for bit, on all threads; the factors are read once
/// for `relit_together` of them. `pictures` becomes what they make, by scene; images that are there
/// are overwritten, so that memory is taken once for many calls.
void relight(const Factors& factors, std::span<const v1::SceneFactors> scenes,
             const Observer& observer, std::vector<Image>& pictures);
inline constexpr std::size_t relit_together = 4;

/// What three numbers in place of spectra make of it: the answer of the method `rgb`.
Image relight_rgb(const Factors& factors, const v1::SceneFactors& scene, const Observer& observer);

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
