#pragma once

#include <cstdint>
#include <vector>

/// What of a mirror is left by a rough surface, exp(−(4πs/λ)²) (X. D. He et al., 1991, their
/// e^−g), as a table over the depth s in µm: what a ray meets is two weights on neighbouring nodes,
/// and the wavelengths are seen once a pixel and node.
namespace metamer {

/// Nodes lie evenly up to 0.33 µm, where 1e-11 is left of 830 nm; deeper ones count as that.
/// Between two, a line is off by 1.3e-4 at 360 nm and by 6e-5 at 550 nm at most, step²/4 (4π/λ)².
inline constexpr std::uint32_t rough_mirror_nodes = 512;
inline constexpr double deepest_rough_mirror = 0.33;
double rough_mirror_node(std::uint32_t i);

/// Between nodes `below` and `below` + 1, `fraction` of the way.
struct RoughMirrorPlace {
  std::uint32_t below;
  float fraction;
};
/// `depth`: 0 or more.
RoughMirrorPlace rough_mirror_place(float depth);

/// By wavelength.
std::vector<double> rough_mirror(double depth, const std::vector<double>& nm);

}  // namespace metamer
