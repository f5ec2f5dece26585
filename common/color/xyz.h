#pragma once

#include <array>
#include <vector>

#include "common/spectral/cie.h"
#include "common/spectral/wavelengths.h"

namespace metamer {

/// Tristimulus values X, Y, Z, relative to luminance 1.
using Xyz = std::array<double, 3>;

/// An observer at the positions of a rendering: x̄Δλ, ȳΔλ, z̄Δλ, so that XYZ is three dot products
/// (E[3.2-2], all N samples, with the cell widths of Fig. 4-2). Outside its table it sees nothing.
struct ObserverWeights {
  std::array<std::vector<double>, 3> weights;
};

ObserverWeights observer_weights(cie::Observer observer, const Wavelengths& wavelengths);

/// E[3.2-2]: X = Σ x̄ Φ Δλ and so on; `power` has a value for each wavelength.
Xyz to_xyz(const ObserverWeights& observer, const std::vector<double>& power);

/// The observer of reflectances under a light of `power`, whose luminance is made 1: the X Y Z of a
/// reflectance are three dot products, and those of a perfect white are the light's white. All 0
/// where the light is dark.
ObserverWeights under_light(ObserverWeights observer, const std::vector<double>& power);

/// ξ of E[3.2-4] = luminance / Σ ȳ Φ Δλ, the factor that gives `power` that luminance.
/// 0 where the observer sees nothing of it: such a light stays dark, and the caller says so.
double luminance_scale(const ObserverWeights& observer, const std::vector<double>& power,
                       double luminance);

}  // namespace metamer
