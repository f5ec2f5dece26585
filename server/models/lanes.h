#pragma once

#include "common/models/reflection.h"
#include "server/cpu/lanes.h"

namespace metamer::models {

/// The model for eight points of one material, in f32 by the shared sources.
Lobes<Float8> evaluate(const Reflection<float>& reflection, const Angles<Float8>& angles);

/// What lobes whose geometry depends on wavelength are multiplied by, at a wavelength: see
/// shaders/models/ripples.glsl. Their heights are not negative.
Float8 ripples(Float8 height, Float8 spread, float nm);
/// As in common/models/reference.h.
struct RoughMirrorF32 {
  float masking, depth;
};
RoughMirrorF32 rough_mirror(const Reflection<float>::Parameters& parameters, float u);

/// The parts by themselves, for tests.
Float8 slope(Slope which, const Reflection<float>::Parameters& parameters,
             const Angles<Float8>& angles);
Float8 attenuation(Attenuation which, float roughness, const Angles<Float8>& angles);
Float8 diffuse(DiffuseTerm which, const Reflection<float>::Parameters& parameters,
               const Angles<Float8>& angles);
float schlick_rise(float u);  ///< (1 − u)⁵
float dielectric_fresnel(float u, float n);
float conductor_fresnel(float u, float n, float k);
float schlick_fresnel(float u, float f);
float index_from_reflectance(float f);

}  // namespace metamer::models
