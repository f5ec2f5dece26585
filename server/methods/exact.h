#pragma once

#include "server/methods/method.h"

namespace metamer {

/// The 1 nm answer at the price of RGB. Without dispersion, the light that reaches a pixel along a
/// path is (product of scalars) × (light spectrum × product of surface spectra). The second factor
/// is one of few; it is named by its signature (light, row, row, …), integrated to XYZ once at 1
/// nm, and looked up. The cosine of an exact Fresnel term is a weight on two rows
/// (fresnel_table.h).
///
/// Signatures over mirrors are integrated when they are first met. What they take is bounded:
/// beyond that they are integrated each time, which is slow and gives the same bits.
std::unique_ptr<Method> make_exact(const v1::Plan& plan, const RenderScene& scene);

/// Says how many signatures the scene has without mirrors.
void plan_exact(const RenderScene& scene, const v1::Settings& settings, v1::Plan& plan);

/// The signatures that paths without mirrors can have: lights × rows.
std::uint64_t direct_signatures(const RenderScene& scene);

}  // namespace metamer
