#include <cmath>
#include <cstring>

#include "server/models/models.h"

// glibc has vector forms of these; telling the compiler so lets it evaluate eight lanes with one
// call. Their error is below one unit in the last place (tests/server/render/models).
#if defined(__x86_64__) && defined(__AVX2__)
extern "C" {
__attribute__((simd("notinbranch"))) float powf(float, float) noexcept;
__attribute__((simd("notinbranch"))) float expf(float) noexcept;
__attribute__((simd("notinbranch"))) float logf(float) noexcept;
}
#endif

#pragma GCC diagnostic ignored "-Wunused-function"

namespace metamer::models {
namespace f32 {
using Real = float;
namespace {
Real pow(Real x, Real y) { return ::powf(x, y); }
#include "server/models/all_models.inc"
}  // namespace
}  // namespace f32

namespace f64 {
using Real = double;
namespace {
using std::pow;
#include "server/models/all_models.inc"
}  // namespace
}  // namespace f64

namespace {

/// The model's own struct, filled from the flat list that a material keeps.
template <class Struct, class Real>
Struct unpack(const std::array<Real, max_parameters>& parameters) {
  static_assert(sizeof(Struct) <= sizeof parameters, "raise max_parameters");
  Struct result;
  std::memcpy(&result, parameters.data(), sizeof result);
  return result;
}

template <class Struct, f32::Lobes (*model)(f32::Angles, Struct)>
LobeLanes evaluate_lanes(const Parameters& parameters, const AngleLanes& angles) {
  const auto own = unpack<Struct>(parameters);
  LobeLanes lobes;
  for (int i = 0; i < lane_count; ++i) {
    const f32::Lobes one = model({angles.n_dot_l[i], angles.n_dot_h[i]}, own);
    lobes.diffuse[i] = one.diffuse;
    lobes.specular[i] = one.specular;
    lobes.white[i] = one.white;
  }
  return lobes;
}

}  // namespace

LobeLanes evaluate(Model model, const Parameters& parameters, const AngleLanes& angles) {
  switch (model) {
#define METAMER_MODEL(number, name, Type, citation, ...) \
  case Model::name:                                      \
    return evaluate_lanes<f32::Type, f32::name>(parameters, angles);
#include "server/models/models.def"
#undef METAMER_MODEL
  }
  __builtin_unreachable();
}

Lobes64 evaluate(Model model, const Parameters64& parameters, const Angles64& angles) {
  f64::Lobes lobes{};
  switch (model) {
#define METAMER_MODEL(number, name, Type, citation, ...)                                \
  case Model::name:                                                                     \
    lobes = f64::name({angles.n_dot_l, angles.n_dot_h}, unpack<f64::Type>(parameters)); \
    break;
#include "server/models/models.def"
#undef METAMER_MODEL
  }
  return {lobes.diffuse, lobes.specular, lobes.white};
}

}  // namespace metamer::models
