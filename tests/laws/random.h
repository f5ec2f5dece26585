#pragma once

#include <Eigen/Core>
#include <random>

#include "common/models/reflection.h"

/// Random inputs over the whole of their ranges, the ends included. The same on every run.
namespace metamer::laws {

/// The sanitizers look for mistakes of memory, and a tenth of the inputs meets them all.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr int law_inputs = 100'000, law_integrals = 30;
#else
inline constexpr int law_inputs = 1'000'000, law_integrals = 300;
#endif

class Random {
 public:
  double between(double min, double max);

  /// Over a parameter's range, evenly or, where it spans decades, by decade.
  double parameter(const models::Parameter& parameter);
  /// In the order of models.def; a model's follow its diffuseness and specularness, whose sum is 1.
  models::Reflection<double>::Parameters parameters(const models::Entry& entry);

  /// A model with any of the parts that it can have, all its numbers exact in f32.
  models::Reflection<double> reflection(const models::Entry& model);

  /// A unit vector above the surface, whose normal is z: evenly, or towards its pole or horizon.
  Eigen::Vector3d direction();
  /// For the viewer: any, or next to the mirror image of the light, where highlights are.
  Eigen::Vector3d towards_mirror(const Eigen::Vector3d& to_light);

 private:
  const models::Entry& one_of(models::Kind kind);

  std::mt19937_64 engine_{20041};
  std::uniform_real_distribution<double> uniform_{0, 1};
};

const Eigen::Vector3d normal{0, 0, 1}, tangent{1, 0, 0};

/// The roughness that an attenuation takes from one slope: as common/scene/reflection.cpp has it.
double roughness_of(const models::Entry& slope,
                    const models::Reflection<double>::Parameters& parameters);

/// The numbers that f32 keeps, so that both builds get the same.
models::Reflection<double> rounded_to_f32(models::Reflection<double> reflection);
models::Angles<double> rounded_to_f32(models::Angles<double> angles);

/// The same, but that the viewer is where a mirror would throw the light, and highlights peak.
models::Angles<double> mirrored(models::Angles<double> angles);

}  // namespace metamer::laws
