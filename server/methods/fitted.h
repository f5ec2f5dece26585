#pragma once

#include "common/spectral/cie.h"
#include "server/methods/method.h"

/// Point sampling at wavelengths that are chosen for a scene, each with weights of its own for X, Y
/// and Z, so that what the scene can show comes out as it would at every nanometre.
namespace metamer {

/// At most `most` wavelengths (nm, whole, rising, at least one) for the scene's lights and
/// surfaces. Fewer, where more would not bring its colours 0.01 ΔE closer.
std::vector<double> fitted_wavelengths(const RenderScene& scene, const Observer& observer,
                                       std::size_t most);

/// The wavelengths that were chosen are part of the plan.
void plan_fitted(const RenderScene& scene, const v1::Settings& settings, v1::Plan& plan);

/// Carries a value at each wavelength that the plan lists; at those above, where it lists none.
/// Each light keeps its own X Y Z, so that neutral stays neutral; of many lights, as many of the
/// first as are half the wavelengths.
std::unique_ptr<Method> make_fitted(const v1::Plan& plan, const RenderScene& scene);

}  // namespace metamer
