#include "tests/laws/reflectance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "common/models/reference.h"
#include "common/problem.h"
#include "tests/laws/random.h"

namespace metamer::laws {
namespace {

using models::Entry, models::Kind, models::Reflection;
using std::numbers::pi;

/// ∫₀¹ 2hD dh at one azimuth, by the logarithm of t = tan α: 2h dh = 2t/(1+t²)² dt. The sum of an
/// even grid converges faster than any power of its step, as the integrand fades at both ends.
double integral(models::Slope slope, const Reflection<double>::Parameters& parameters,
                double square_of_azimuth) {
  constexpr double step = 0.04;
  double sum = 0;
  for (double x = std::log(1e-8); x < std::log(1e5); x += step) {
    const double t2 = std::exp(2 * x);
    models::Angles<double> angles{};
    angles.n_dot_h = 1 / std::sqrt(1 + t2);
    angles.n_h_versine = t2 / (1 + t2) / (1 + angles.n_dot_h);
    angles.tangent = square_of_azimuth;
    angles.bitangent = 1 - square_of_azimuth;
    sum += models::slope(slope, parameters, angles) * 2 * t2 / ((1 + t2) * (1 + t2)) * step;
  }
  return sum;
}

/// The same, its mean over the azimuths where the slope knows them.
double integral(const Entry& slope, const Reflection<double>::Parameters& parameters) {
  const auto which = static_cast<models::Slope>(slope.index);
  if (!(slope.traits & models::anisotropic)) return integral(which, parameters, 1);
  // Azimuths enough for a lobe as narrow as one roughness by the other.
  const double ratio = std::max(parameters[0] / parameters[1], parameters[1] / parameters[0]);
  const int count = static_cast<int>(12 * ratio) + 16;
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const double cosine = std::cos((i + 0.5) * pi / (2 * count));
    sum += integral(which, parameters, cosine * cosine) / count;
  }
  return sum;
}

TEST(ReflectanceLaws, ConservingSlopesAreNormalised) {  // E[2.2-14]
  for (const Entry& slope : models::registry(Kind::slope)) {
    if (!(slope.traits & models::conserving)) continue;
    Random random;
    for (int i = 0; i < 200; ++i) {
      const auto parameters = random.parameters(slope);
      EXPECT_NEAR(integral(slope, parameters), 1, 1e-6)
          << slope.name << " " << ::testing::PrintToString(parameters);
    }
  }
}

constexpr double error_of_sum = 2e-3;  // Of hemispherical_reflectance.

std::string described(const Reflection<double>& reflection, const Eigen::Vector3d& to_light) {
  const auto& slope = reflection.slopes[0];
  return "N·L " + number_text(to_light.z()) + ", diffuse term " +
         std::to_string(int(reflection.diffuse)) + " " +
         ::testing::PrintToString(reflection.diffuse_parameters) + ", slope " +
         std::to_string(int(slope.slope)) + " " + ::testing::PrintToString(slope.parameters) +
         ", attenuation " + std::to_string(int(reflection.attenuation)) + " " +
         number_text(reflection.roughness);
}

/// The promise is the model's, for Lambert's diffuse term and slopes that are distributions.
TEST(ReflectanceLaws, ConservingModelsReflectNoMoreThanTheyGet) {
  for (const Entry& model : models::registry(Kind::model)) {
    if (!(model.traits & models::conserving)) continue;
    Random random;
    // A series at each point takes its time.
    const int count = model.traits & models::diffracting ? law_integrals / 20 : law_integrals;
    for (int i = 0; i < count; ++i) {
      auto reflection = random.reflection(model);
      reflection.diffuse = models::DiffuseTerm::lambert;
      if (reflection.slope_count > 0 &&
          !(models::entry(reflection.slopes[0].slope).traits & models::conserving))
        continue;
      const Eigen::Vector3d to_light = random.direction();
      EXPECT_LE(hemispherical_reflectance(reflection, to_light), 1 + error_of_sum)
          << model.name << ", " << described(reflection, to_light);
    }
  }
}

TEST(ReflectanceLaws, ConservingDiffuseTermsReflectNoMoreThanTheyGet) {
  for (const Entry& term : models::registry(Kind::diffuse)) {
    Random random;
    double most = 0;
    std::string where;
    for (int i = 0; i < law_integrals; ++i) {
      auto reflection = models::default_reflection(models::Model::lambert);
      reflection.parameters[0] = 1;
      reflection.diffuse = static_cast<models::DiffuseTerm>(term.index);
      reflection.diffuse_parameters = random.parameters(term);
      const Eigen::Vector3d to_light = random.direction();
      const double value = hemispherical_reflectance(reflection, to_light);
      if (value > most) where = described(reflection, to_light);
      most = std::max(most, value);
    }
    std::printf("%s reflects at most %.4f (%s)\n", term.name, most, where.c_str());
    const bool promised = term.traits & models::conserving;
    EXPECT_TRUE(!promised || most <= 1 + error_of_sum) << term.name << " reflects " << most;
  }
}

TEST(ReflectanceLaws, AWhiteLambertianReflectsEverything) {
  auto reflection = models::default_reflection(models::Model::lambert);
  reflection.parameters[0] = 1;
  EXPECT_NEAR(hemispherical_reflectance(reflection, Eigen::Vector3d(0.6, 0, 0.8)), 1, 2e-3);
}

TEST(ReflectanceLaws, ReflectanceOfEveryModelIsMeasured) {
  const std::string table = reflectance_table();
  std::printf("%s", table.c_str());
  for (const models::Entry& model : models::registry(models::Kind::model))
    EXPECT_NE(table.find("| " + std::string(model.name)), std::string::npos) << model.name;
}

}  // namespace
}  // namespace metamer::laws
