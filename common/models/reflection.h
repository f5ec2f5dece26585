#pragma once

#include <array>
#include <cstddef>

#include "common/models/registry.h"

/// The values that the shared sources in shaders/ work on, for one number type.
namespace metamer::models {

/// See shaders/models/lobes.glsl, which has the same members in the same order.
template <class Number>
struct Angles {
  Number n_dot_l, n_dot_v, n_dot_h, v_dot_h, r_dot_v;
  Number n_l_versine, n_v_versine, n_h_versine, r_v_versine;
  Number azimuth, tangent, bitangent, solid_angle;
};

/// See shaders/models/lobes.glsl.
template <class Number>
struct Lobes {
  Number diffuse, specular, white, fresnel, cosine, height, spread;
};

inline constexpr std::size_t max_parameters = 8;  ///< Of one line of models.def.
inline constexpr std::size_t max_slopes = 4;      ///< Of one material.

/// How a surface reflects: its model and the model's parts, without any spectrum.
template <class Real>
struct Reflection {
  /// In the order of models.def; a model's follow its diffuseness and specularness.
  using Parameters = std::array<Real, max_parameters + 2>;

  struct WeightedSlope {
    Slope slope;
    Real weight;
    Parameters parameters;
  };

  Model model = Model::lambert;
  Parameters parameters{Real(1)};
  DiffuseTerm diffuse = DiffuseTerm::lambert;
  Parameters diffuse_parameters{};
  std::array<WeightedSlope, max_slopes> slopes{};  ///< The first `slope_count` of them.
  std::size_t slope_count = 0;
  Attenuation attenuation{};
  Real roughness{};  ///< σ of the attenuation: that of the slopes.
};

}  // namespace metamer::models
