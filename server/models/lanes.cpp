#include "server/models/lanes.h"

#include <cmath>
#include <cstring>

// glibc has vector forms of these; telling the compiler so lets it evaluate eight lanes with one
// call. Their error is within a few units in the last place (tests/extremes).
#if defined(__x86_64__) && defined(__AVX2__)
extern "C" {
__attribute__((simd("notinbranch"))) float expf(float) noexcept;
__attribute__((simd("notinbranch"))) float logf(float) noexcept;
__attribute__((simd("notinbranch"))) float log1pf(float) noexcept;
__attribute__((simd("notinbranch"))) float asinf(float) noexcept;
__attribute__((simd("notinbranch"))) float erff(float) noexcept;
}
#endif

#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"

namespace metamer::models {
namespace f32 {
namespace {
using Real = float;
using Wide = LaneGroup;
constexpr int width = group_size;
Real exp(Real x) { return ::expf(x); }
Real log(Real x) { return ::logf(x); }
Real log1p(Real x) { return ::log1pf(x); }
Real asin(Real x) { return ::asinf(x); }
Real erf(Real x) { return ::erff(x); }
Real sqrt(Real x) { return __builtin_sqrtf(x); }
Real fma(Real x, Real y, Real z) { return __builtin_fmaf(x, y, z); }
Real floor(Real x) { return __builtin_floorf(x); }
Real abs(Real x) { return __builtin_fabsf(x); }
Real min(Real a, Real b) { return a < b ? a : b; }
Real max(Real a, Real b) { return a > b ? a : b; }
#include "common/models/shared_source.inc"
}  // namespace
}  // namespace f32

Lobes<LaneGroup> evaluate(const Reflection<float>& reflection, const Angles<LaneGroup>& angles) {
  return f32::evaluate(reflection, angles);
}
LaneGroup ripples(LaneGroup height, LaneGroup spread, float nm) {
  const float k = 6283.1853f / nm;
  return f32::ripples_value(height, spread, k * k);
}
RoughMirrorF32 rough_mirror(const Reflection<float>::Parameters& parameters, float u) {
  const auto mirror = f32::he_torrance_mirror(u, 1 - u, f32::unpack<f32::HeTorrance>(parameters));
  return {mirror.masking, mirror.depth};
}
LaneGroup slope(Slope which, const Reflection<float>::Parameters& parameters,
                const Angles<LaneGroup>& angles) {
  return f32::slope_value(which, parameters, angles);
}
LaneGroup attenuation(Attenuation which, float roughness, const Angles<LaneGroup>& angles) {
  return f32::attenuation_value(which, roughness, angles);
}
LaneGroup diffuse(DiffuseTerm which, const Reflection<float>::Parameters& parameters,
                  const Angles<LaneGroup>& angles) {
  return f32::diffuse_value(which, parameters, angles);
}
float schlick_rise(float u) { return f32::schlick_rise(u); }
float dielectric_fresnel(float u, float n) { return f32::dielectric_fresnel(u, n); }
float conductor_fresnel(float u, float n, float k) { return f32::conductor_fresnel(u, n, k); }
float schlick_fresnel(float u, float f) { return f32::schlick_fresnel(u, f); }
float index_from_reflectance(float f) { return f32::index_from_reflectance(f); }

}  // namespace metamer::models
