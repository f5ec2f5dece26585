#pragma once

#include "server/scene/render_scene.h"

/// Wavelengths that go the same way together, where media disperse light.
namespace metamer {

inline constexpr std::size_t max_bundles = 64;  ///< Each is a ray of its own.

/// Chooses the scene's windows: hat functions, whose sum is 1, so that n of each of the dispersing
/// media changes by at most half of a pixel's angle (radians) from the middle of one to the next,
/// where eyes see more than a thousandth: 390 to 710 nm. None where no object disperses. A notice
/// where that would be more than max_bundles.
void choose_windows(RenderScene& scene);

/// n of a medium in the middle of a window.
double index_in(const RenderScene& scene, const RenderMedium& medium, const Spectrum& window);
/// nm.
double middle_of(const Spectrum& window);

}  // namespace metamer
