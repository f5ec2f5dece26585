#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "common/scene/fresnel.h"

/// An exact Fresnel term as a table over the cosine: what a ray meets is two weights on
/// neighbouring nodes, and the wavelengths are seen once a pixel and node.
namespace metamer {

/// Nodes lie at u = (i / (n − 1))², close to each other at grazing incidence, where F rises. 512
/// keep the error of a line between two below 2e-5 for every shipped metal and medium (tests).
inline constexpr std::uint32_t fresnel_nodes = 512;

inline double fresnel_node(std::uint32_t i) {
  const double t = static_cast<double>(i) / (fresnel_nodes - 1);
  return t * t;
}

/// Where a cosine in 0..1 lies: between nodes `below` and `below` + 1, `fraction` of the way.
struct FresnelPlace {
  std::uint32_t below;
  float fraction;
};

namespace f32 {
using std::floor, std::min, std::sqrt;
/// The shared source as members, which may stand in a header.
struct FresnelNodes {
  using Real = float;
#include "shaders/fresnel/nodes.glsl"
};
}  // namespace f32

inline FresnelPlace fresnel_place(float cosine) {
  constexpr float last = fresnel_nodes - 1;
  f32::FresnelNodes nodes;
  const float below = nodes.node_below(cosine, last);
  return {static_cast<std::uint32_t>(below), nodes.node_share(cosine, below, last)};
}

/// n and k at a method's wavelengths; k empty for a dielectric.
struct ConstantsAt {
  std::vector<double> n, k;
};
ConstantsAt resample(const OpticalConstants& constants, const std::vector<double>& nm);

/// F at every wavelength for one cosine; E[2.2-8], E[2.2-9].
std::vector<double> fresnel_at(const ConstantsAt& constants, double cosine);

}  // namespace metamer
