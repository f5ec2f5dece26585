#pragma once

#include <string>

#include "common/scene/validate.h"

namespace metamer {

/// n(λ) and k(λ) of an exact Fresnel term.
struct OpticalConstants {
  Spectrum n;
  Spectrum k;  ///< Empty: a dielectric.
};

/// What a dielectric or a conductor stands for; a formula is tabulated at every nm, a reflectance
/// turned into n there and at its own samples. Errors as load_spectrum's. The message is sound
/// (check_fresnel) and not Schlick's.
Result<OpticalConstants> load_fresnel(const v1::Fresnel& fresnel, const std::string& field,
                                      const AssetReader& assets);

/// What is wrong with a dispersion formula at visible wavelengths: "n must lie in 0.01..100 (it is
/// 0 at 360 nm)". Empty: nothing, or it is no formula.
std::string formula_fault(const v1::Dielectric& dielectric);

}  // namespace metamer
