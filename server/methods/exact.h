#pragma once

#include "server/methods/method.h"

namespace metamer {

/// The answer of the reference at the price of RGB. Without dispersion, the light that reaches a
/// pixel along a path is (product of scalars) × (light spectrum × product of surface spectra). The
/// second factor is one of few; it is named by its signature (light, row, row, …), integrated to
/// X Y Z once, and looked up. The cosine of an exact Fresnel term is a weight on two rows
/// (fresnel_table.h).
///
/// What mirrors show is looked up likewise where few signatures are possible, and carried as one
/// value a band where they are many (carries_bands): with each Fresnel mirror on the way their
/// number grows a thousandfold.
std::unique_ptr<Method> make_exact(const v1::Plan& plan, const RenderScene& scene);

/// Says how many signatures the scene has without mirrors.
void plan_exact(const RenderScene& scene, const v1::Settings& settings, v1::Plan& plan);

/// Whether what mirrors show is carried as bands, by paths with up to `depth` mirrors.
bool carries_bands(const RenderScene& scene, std::uint32_t depth);

/// The signatures that paths without mirrors can have: lights × rows.
std::uint64_t direct_signatures(const RenderScene& scene);

}  // namespace metamer
