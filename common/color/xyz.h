#pragma once

#include <array>
#include <vector>

#include "common/spectral/cells.h"
#include "common/spectral/cie.h"

namespace metamer {

/// Tristimulus values X, Y, Z, relative to luminance 1.
using Xyz = std::array<double, 3>;

/// The matching functions of an observer and what else makes cells (cells_of).
std::vector<const Spectrum*> with_observer(const Observer& observer,
                                           std::vector<const Spectrum*> spectra);

/// An observer at the positions of a rendering: x̄Δλ, ȳΔλ, z̄Δλ, so that XYZ is three dot products
/// (E[3.2-2], all N samples, with the cell widths of Fig. 4-2). Outside its table it sees nothing.
struct ObserverWeights {
  std::array<std::vector<double>, 3> weights;
};

ObserverWeights observer_weights(const Observer& observer, const Wavelengths& wavelengths);

/// E[3.2-2]: X = Σ x̄ Φ Δλ and so on; `power` has a value for each wavelength.
Xyz to_xyz(const ObserverWeights& observer, const std::vector<double>& power);

/// The observer of reflectances under a light whose luminance is made 1: the X Y Z of a reflectance
/// are three dot products with its values at `nm`, exact where it is a straight line between these,
/// and keeps its end values. Those of a perfect white are the light's white. All 0 where the light
/// is dark.
ObserverWeights under_light(const Observer& observer, const Spectrum& emission,
                            const std::vector<double>& nm);

/// An observer of band means (band_means): of all sums over bands at `nm` (rising), the one that is
/// nearest to the integral, as x̄, ȳ, z̄ are taken by their least-squares approximation in hat
/// functions. Exact where the light is a straight line. A single band is seen as a sample.
ObserverWeights observer_of_bands(const Observer& observer, const std::vector<double>& nm);

/// X Y Z of a light as it is: the integral from 360 to 830 nm. Here and above, a light of a single
/// sample is a line (as_emission).
Xyz emission_xyz(const Spectrum& emission, const Observer& observer);

/// X Y Z of a light whose luminance is made 1; all 0 where it is dark.
Xyz white_of(const Spectrum& emission, const Observer& observer);

/// ξ of E[3.2-4] = luminance / Σ ȳ Φ Δλ, the factor that gives `power` that luminance.
/// 0 where the observer sees nothing of it: such a light stays dark, and the caller says so.
double luminance_scale(const ObserverWeights& observer, const std::vector<double>& power,
                       double luminance);

}  // namespace metamer
