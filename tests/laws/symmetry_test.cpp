#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/models/reference.h"
#include "tests/laws/random.h"

namespace metamer::laws {
namespace {

using Eigen::Vector3d;
using models::Angles, models::Entry, models::Kind, models::Reflection;

constexpr int count = law_inputs;
constexpr double rounding = 1e-9;  // Vectors are unit to 1e-16, which exponents of 1e6 raise.

/// With C_D = 0.7, C_S = 0.6 and a Fresnel term of 0.04, so that nothing passes for something else.
double highlight(const models::Lobes<double>& lobes) {
  return 0.6 * lobes.specular + lobes.white +
         lobes.fresnel * models::schlick_fresnel(lobes.cosine, 0.04);
}
double reflected(const models::Lobes<double>& lobes) {
  return 0.7 * lobes.diffuse + highlight(lobes);
}

/// Two directions; at most one of them next to the horizon, and not opposite, where the cosines
/// themselves carry no more than a few digits.
struct Pair {
  Vector3d to_light, to_viewer;
};
Pair pair(Random& random) {
  for (;;) {
    const Vector3d light = random.direction(), viewer = random.towards_mirror(light);
    if (light.z() > 1e-4 && viewer.z() > 1e-4 && (light + viewer).norm() > 1e-2)
      return {light, viewer};
  }
}

Angles<double> angles(const Vector3d& to_light, const Vector3d& to_viewer) {
  return models::angles_between(normal, tangent, to_light, to_viewer);
}

testing::AssertionResult same(double a, double b, double peak) {
  if (std::abs(a - b) <= rounding * std::max({a, b, peak})) return testing::AssertionSuccess();
  return testing::AssertionFailure() << a << " is not " << b;
}

TEST(SymmetryLaws, ReciprocalModelsLetLightAndViewerChangePlaces) {
  for (const Entry& model : models::registry(Kind::model)) {
    if (!(model.traits & models::reciprocal)) continue;
    Random random;
    for (int i = 0; i < count && !HasFailure(); ++i) {
      const auto reflection = random.reflection(model);
      const auto [light, viewer] = pair(random);
      const double forth =
          reflected(models::evaluate(reflection, angles(light, viewer))) / light.z();
      const double back =
          reflected(models::evaluate(reflection, angles(viewer, light))) / viewer.z();
      EXPECT_TRUE(same(forth, back, 0))
          << model.name << " " << light.transpose() << ", " << viewer.transpose();
    }
  }
}

TEST(SymmetryLaws, ReciprocalDiffuseTermsLetLightAndViewerChangePlaces) {
  for (const Entry& term : models::registry(Kind::diffuse)) {
    if (!(term.traits & models::reciprocal)) continue;
    Random random;
    const auto which = static_cast<models::DiffuseTerm>(term.index);
    for (int i = 0; i < count && !HasFailure(); ++i) {
      const auto parameters = random.parameters(term);
      const auto [light, viewer] = pair(random);
      const double forth = models::diffuse(which, parameters, angles(light, viewer)) / light.z();
      const double back = models::diffuse(which, parameters, angles(viewer, light)) / viewer.z();
      EXPECT_TRUE(same(forth, back, 0)) << term.name;
    }
  }
}

TEST(SymmetryLaws, SymmetricHighlightsLetLightAndViewerChangePlaces) {
  for (const Entry& model : models::registry(Kind::model)) {
    if (!(model.traits & models::symmetric_highlight)) continue;
    Random random;
    for (int i = 0; i < count && !HasFailure(); ++i) {
      const auto reflection = random.reflection(model);
      const auto [light, viewer] = pair(random);
      const double forth = highlight(models::evaluate(reflection, angles(light, viewer)));
      const double back = highlight(models::evaluate(reflection, angles(viewer, light)));
      EXPECT_TRUE(same(forth, back, 0)) << model.name;
    }
  }
}

TEST(SymmetryLaws, PhongAndStraussHaveNeitherAsAnExampleShows) {
  // Light 70° and viewer 50° from the normal on opposite sides: 20° off the mirror direction.
  const auto at = [](double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return Vector3d(std::sin(angle), 0, std::cos(angle));
  };
  const Vector3d light = at(70), viewer = at(-50);
  for (const auto which : {models::Model::phong, models::Model::strauss}) {
    const Entry& model = models::entry(which);
    EXPECT_FALSE(model.traits & (models::reciprocal | models::symmetric_highlight)) << model.name;
    auto reflection = models::default_reflection(which);
    for (std::size_t i = 0; i < model.parameters.size(); ++i) {
      // An exponent of 5 and a half-metallic, half-smooth surface reach that far.
      if (std::string(model.parameters[i].name) == "shininess") reflection.parameters[2 + i] = 5;
      if (std::string(model.parameters[i].name) == "metalness") reflection.parameters[2 + i] = 0.5;
    }
    const auto forth = models::evaluate(reflection, angles(light, viewer));
    const auto back = models::evaluate(reflection, angles(viewer, light));
    EXPECT_GT(std::abs(highlight(forth) / highlight(back) - 1), 0.01) << model.name;
    EXPECT_GT(std::abs(reflected(forth) / light.z() / (reflected(back) / viewer.z()) - 1), 0.01)
        << model.name;
  }
}

/// Isotropic: no part of it needs the tangent.
bool isotropic(const Entry& model, const Reflection<double>& reflection) {
  const unsigned slope =
      reflection.slope_count > 0 ? models::entry(reflection.slopes[0].slope).traits : 0u;
  return !((model.traits | slope) & models::anisotropic);
}

TEST(SymmetryLaws, IsotropicModelsDoNotChangeWhenEverythingIsTurnedAboutTheNormal) {
  for (const Entry& model : models::registry(Kind::model)) {
    Random random;
    for (int i = 0; i < count && !HasFailure(); ++i) {
      const auto reflection = random.reflection(model);
      const auto [light, viewer] = pair(random);
      const Eigen::AngleAxisd turn(random.between(0, 2 * std::numbers::pi), normal);
      if (!isotropic(model, reflection)) continue;
      const auto at = angles(light, viewer);
      auto mirrored = at;
      mirrored.n_dot_h = mirrored.r_dot_v = 1;
      mirrored.n_h_versine = mirrored.r_v_versine = 0;
      const double peak = reflected(models::evaluate(reflection, mirrored));
      const double still = reflected(models::evaluate(reflection, at));
      const double turned =
          reflected(models::evaluate(reflection, angles(turn * light, turn * viewer)));
      EXPECT_TRUE(same(still, turned, peak)) << model.name;
    }
  }
}

TEST(SymmetryLaws, AnisotropicModelsAndSlopesDoChange) {
  const Vector3d light = Vector3d(0.3, 0, 1).normalized(),
                 viewer = Vector3d(0.2, 0.1, 1).normalized();
  const Eigen::AngleAxisd turn(std::numbers::pi / 2, normal);
  const auto before = angles(light, viewer), after = angles(turn * light, turn * viewer);
  for (const Entry& model : models::registry(Kind::model)) {
    if (!(model.traits & models::anisotropic)) continue;
    const auto reflection = models::default_reflection(static_cast<models::Model>(model.index));
    EXPECT_GT(std::abs(highlight(models::evaluate(reflection, before)) /
                           highlight(models::evaluate(reflection, after)) -
                       1),
              0.1)
        << model.name;
  }
  for (const Entry& slope : models::registry(Kind::slope)) {
    if (!(slope.traits & models::anisotropic)) continue;
    const auto which = static_cast<models::Slope>(slope.index);
    Reflection<double>::Parameters usual{};
    for (std::size_t i = 0; i < slope.parameters.size(); ++i)
      usual[i] = slope.parameters[i].default_value;
    EXPECT_GT(
        std::abs(models::slope(which, usual, before) / models::slope(which, usual, after) - 1), 0.1)
        << slope.name;
  }
}

}  // namespace
}  // namespace metamer::laws
