#pragma once

#include "server/methods/method.h"

namespace metamer {

/// The answer of the reference at the price of RGB. Without dispersion, the light that reaches a
/// pixel along a path is (product of scalars) × (light spectrum × product of surface spectra).
/// Light that comes straight from a surface is one of few such products (signatures: light, row),
/// which are integrated to X Y Z once and looked up. Light that comes by mirrors is carried back
/// over them in bands: few, chosen for the scene, and each surface under each light has a sensor
/// that makes the sum over them the integral (common/color/chain_bands.h).
std::unique_ptr<Method> make_exact(const v1::Plan& plan, const RenderScene& scene);

/// Says how many signatures the scene has without mirrors.
void plan_exact(const RenderScene& scene, const v1::Settings& settings, v1::Plan& plan);

/// The signatures that paths without mirrors can have: lights × rows.
std::uint64_t direct_signatures(const RenderScene& scene);

}  // namespace metamer
