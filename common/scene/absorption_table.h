#pragma once

#include <cstdint>
#include <vector>

#include "common/spectral/spectrum.h"

/// Absorption along a way as a table over its length: what a ray meets is two weights on
/// neighbouring nodes, and the wavelengths are seen once a pixel and node. Lengths are optical
/// ones s, the depth −ln T of the wavelength that is absorbed most; another's depth is α s with a
/// constant α in 0..1.
namespace metamer {

/// Nodes lie evenly in 1 − exp(−s/2) up to s = 2, then evenly in ln s. Between two, a line is off
/// by at most Δ²/8 max α² exp(−αs): with Δ = step exp(s/2) below 2, where α = 1 is the worst, and Δ
/// = step e/2 s above, where α = 2/s is, that is step²/8 in both, below 2e-5. The last one lies
/// at 1.2e7; longer ways count as that long: where the strongest is absorbed by exp(−1.5e7) within
/// a scene, what is wrong is wavelengths that are absorbed a million times less.
inline constexpr std::uint32_t absorption_nodes = 1024;
double absorption_node(std::uint32_t i);

/// Where an optical length, 0 or more, lies: between nodes `below` and `below` + 1, `fraction` of
/// the way.
struct AbsorptionPlace {
  std::uint32_t below;
  float fraction;
};
AbsorptionPlace absorption_place(float length);

/// The depth −ln T of the wavelength that a transmittance absorbs most; a T of 0 counts as 1e-30.
/// 0: none is absorbed.
double optical_depth(const Spectrum& transmittance);
/// α at each of `nm`; end values hold outside. The depth is above 0.
std::vector<double> relative_depth(const Spectrum& transmittance, const std::vector<double>& nm);
/// exp(−α s).
std::vector<double> transmitted(const std::vector<double>& relative_depth, double length);

}  // namespace metamer
