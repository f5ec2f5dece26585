#pragma once

#include <vector>

#include "common/spectral/spectrum.h"
#include "common/spectral/wavelengths.h"

/// Integrals over wavelength of products of spectra, each of which is a straight line between its
/// samples. What a spectrum says between whole nanometres counts.
namespace metamer {

/// Where cells meet, rising from 360 to 830 nm: every whole nanometre, and every sample of
/// `spectra`, none of which is null. Where those make more than max_cells cells, the narrowest are
/// joined.
std::vector<double> cell_edges(const std::vector<const Spectrum*>& spectra);

/// Wavelengths of which Σ f(λᵢ) widthᵢ is the integral of f from 360 to 830 nm: the two points of
/// Gauss and Legendre in every cell. Exact where f is a polynomial up to the third degree in each
/// cell: a light times a reflectance times an observer.
Wavelengths cells_of(const std::vector<const Spectrum*>& spectra);

inline constexpr std::size_t max_cells = 16384;  ///< 0.03 nm each; 256 KiB of f64 a spectrum.

/// sᵢ such that Σ sᵢ f(λᵢ) is the integral over the product of `density` and the straight lines
/// between the values of f at `nm` (rising). `density` has a value for each of `cells`. Beyond the
/// ends of `nm`, f is 0, or keeps its end values.
std::vector<double> shares(const std::vector<double>& density, const Wavelengths& cells,
                           const std::vector<double>& nm, Outside outside);

/// The light that each of `nm` stands for: its shares with nothing else.
std::vector<double> light_shares(const Spectrum& emission, const std::vector<double>& nm);

/// The mean power that each of `wavelengths` stands for: its share of the light over its width.
/// Beyond their ends light is lost, as it is where it is sampled.
std::vector<double> mean_power(const Spectrum& emission, const Wavelengths& wavelengths);

/// The integrals of the hat functions of `nm` (rising), which are 1 at one position and fall to 0
/// at its neighbours: trapezoids' widths. A single position has the width 1.
std::vector<double> hat_widths(const std::vector<double>& nm);

/// The mean of a light over the hat function of each of `nm`: the band values of a spectral
/// picture. At a single position, its value there.
std::vector<double> band_means(const Spectrum& emission, const std::vector<double>& nm);

}  // namespace metamer
