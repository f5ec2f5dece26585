#pragma once

#include "common/models/reflection.h"
#include "server/cpu/lanes.h"

namespace metamer::models {

// However many groups a packet has, this is compiled once: so that its bits, those of glibc's
// vector functions among them, are the same.

/// The model for a group of points of one material, in f32 by the shared sources.
Lobes<LaneGroup> evaluate(const Reflection<float>& reflection, const Angles<LaneGroup>& angles);

/// What lobes whose geometry depends on wavelength are multiplied by, at a wavelength: see
/// shaders/models/ripples.glsl. Their heights are not negative.
LaneGroup ripples(LaneGroup height, LaneGroup spread, float nm);
/// As in common/models/reference.h.
struct RoughMirrorF32 {
  float masking, depth;
};
RoughMirrorF32 rough_mirror(const Reflection<float>::Parameters& parameters, float u);

/// The parts by themselves, for tests.
LaneGroup slope(Slope which, const Reflection<float>::Parameters& parameters,
                const Angles<LaneGroup>& angles);
LaneGroup attenuation(Attenuation which, float roughness, const Angles<LaneGroup>& angles);
LaneGroup diffuse(DiffuseTerm which, const Reflection<float>::Parameters& parameters,
                  const Angles<LaneGroup>& angles);
float schlick_rise(float u);  ///< (1 − u)⁵
float dielectric_fresnel(float u, float n);
float conductor_fresnel(float u, float n, float k);
float schlick_fresnel(float u, float f);
float index_from_reflectance(float f);

}  // namespace metamer::models
