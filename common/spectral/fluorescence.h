#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/spectral/spectrum.h"

/// Re-radiation, E[3.2-1]: light of one wavelength becomes light of longer ones,
///
///     E(λ) = ∫ M(λ, μ) Φ(μ) dμ,   M in 1/nm, from 300 to 830 nm.
namespace metamer {

inline constexpr double excitation_from_nm = 300, excitation_to_nm = 830;

/// M of molecules that emit the same spectrum wherever they are excited (M. Kasha, Discussions of
/// the Faraday Society 9, 14 (1950)):
///
///     M(λ, μ) = quantum_yield excitation(μ) μ emission(λ) / ∫ emission(λ) λ dλ   where λ ≥ μ
///
/// and 0 where λ < μ: photons that would gain energy are left out.
struct Fluorophore {
  Spectrum excitation;   ///< The share that it absorbs, 0..1; 0 outside, at least two samples.
  Spectrum emission;     ///< Relative power, not 0 everywhere; 0 outside, at least two samples.
  double quantum_yield;  ///< Photons out for each that is absorbed, 0..1.
};

/// M as a table (R. Donaldson, British Journal of Applied Physics 5, 210 (1954)), but for what is
/// reflected: linear between its wavelengths, 0 beyond them and where λ < μ (`turned_up`).
struct BispectralMatrix {
  std::vector<double> excitation, emission;  ///< nm, rising; at least two each.
  std::vector<double> values;                ///< 1/nm, not negative; by excitation, then emission.
};
/// Of all matrices of a scene: as f32 they fit in the message of its factors (SceneFactors).
inline constexpr std::size_t max_bispectral_cells = std::size_t{1} << 18;

using Fluorescence = std::variant<Fluorophore, BispectralMatrix>;

/// E of light of the power Φ, in its unit: exact where both are straight lines between their
/// samples. Where emission and excitation overlap it is taken for a straight line between whole
/// nanometres.
Spectrum reradiated(const Fluorescence& fluorescence, const Spectrum& light);

/// From where to where it is excited, nm; nothing: nowhere.
std::optional<std::array<double, 2>> excited_range(const Fluorescence& fluorescence);

/// ∫ M(λ, μ) dλ at each of `nm`: the share of light of that wavelength that comes out again.
std::vector<double> reradiated_shares(const Fluorescence& fluorescence,
                                      const std::vector<double>& nm);

/// Why no surface does so beside such a reflectance: more comes out than comes in, at some
/// wavelength. Nothing: it may.
std::optional<std::string> energy_fault(const Fluorescence& fluorescence, const Spectrum& diffuse);

/// The share of what is absorbed of equal energy that would be re-radiated at shorter wavelengths,
/// and is left out.
double left_out_share(const Fluorophore& fluorophore);

}  // namespace metamer
