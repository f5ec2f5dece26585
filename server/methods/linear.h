#pragma once

#include "common/spectral/cie.h"
#include "server/methods/linear_basis.h"
#include "server/methods/method.h"

namespace metamer {

/// Spectra as coefficients in a basis made for the scene, 3.3.1 and 4.4: a light is a vector, a
/// reflectance a matrix, XYZ three dot products.
std::unique_ptr<Method> make_linear(const v1::Plan& plan, const RenderScene& scene);

/// How many functions the scene's spectra span, and how good the basis is.
void plan_linear(const RenderScene& scene, const v1::Settings& settings, v1::Plan& plan);

/// The basis of the scene's lights, of each reflected by each spectrum, and, where the method says
/// so, of each reflected twice.
LinearBasis scene_basis(const v1::Linear& method, const Observer& observer,
                        const RenderScene& scene);

}  // namespace metamer
