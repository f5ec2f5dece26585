#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/models/reference.h"
#include "common/problem.h"
#include "server/models/lanes.h"
#include "tests/extremes/table.h"
#include "tests/laws/random.h"

namespace metamer::laws {
namespace {

using models::Angles, models::Entry, models::Kind;

constexpr int batches = law_inputs / 8;  // Of eight points each.

/// Eight points in the form of either build, with the same numbers.
struct Points {
  std::array<Angles<double>, lane_count> f64;
  Angles<Floats> f32;
};

Points points(Random& random) {
  Points result{};
  for (int i = 0; i < lane_count; ++i) {
    const Eigen::Vector3d to_light = random.direction();
    const auto a = rounded_to_f32(
        models::angles_between(normal, tangent, to_light, random.towards_mirror(to_light)));
    result.f64[static_cast<std::size_t>(i)] = a;
    const auto set = [&](Floats& to, double value) { to[i] = static_cast<float>(value); };
    set(result.f32.n_dot_l, a.n_dot_l);
    set(result.f32.n_dot_v, a.n_dot_v);
    set(result.f32.n_dot_h, a.n_dot_h);
    set(result.f32.v_dot_h, a.v_dot_h);
    set(result.f32.r_dot_v, a.r_dot_v);
    set(result.f32.n_l_versine, a.n_l_versine);
    set(result.f32.n_v_versine, a.n_v_versine);
    set(result.f32.n_h_versine, a.n_h_versine);
    set(result.f32.r_v_versine, a.r_v_versine);
    set(result.f32.azimuth, a.azimuth);
    set(result.f32.tangent, a.tangent);
    set(result.f32.bitangent, a.bitangent);
    set(result.f32.solid_angle, a.solid_angle);
  }
  return result;
}

/// Finite, not negative, and the same within the bounds of tests/extremes. `peak` is the value in
/// the mirror direction.
void expect_lawful(double f64, float f32, double peak, const Angles<double>& a, const char* name,
                   double relative = 2e-6) {
  const double bound = std::max({relative * f64, 5e-7 * peak, 1.2e-38});
  const bool lawful = std::isfinite(f64) && f64 >= 0 && std::isfinite(f32) && f32 >= 0 &&
                      std::abs(f64 - double(f32)) <= bound;
  if (lawful) return;
  ADD_FAILURE() << name << " is " << f64 << " in f64, " << f32 << " in f32 at N·L "
                << number_text(a.n_dot_l) << ", N·V " << number_text(a.n_dot_v) << ", N·H "
                << number_text(a.n_dot_h) << ", V·H " << number_text(a.v_dot_h) << ", R·V "
                << number_text(a.r_dot_v);
}

TEST(Laws, LobesAreFiniteAndNotNegativeAndF32AgreesWithF64) {
  for (const Entry& model : models::registry(Kind::model)) {
    Random random;
    for (int batch = 0; batch < batches && !::testing::Test::HasFailure(); ++batch) {
      const auto reflection = random.reflection(model);
      const Points at = points(random);
      const auto lanes = models::evaluate(extremes::single(reflection), at.f32);
      for (int i = 0; i < lane_count; ++i) {
        const auto& angles = at.f64[static_cast<std::size_t>(i)];
        const auto exact = models::evaluate(reflection, angles);
        const auto most = models::evaluate(reflection, mirrored(angles));
        const double peak = std::max({most.diffuse, most.specular, most.white, most.fresnel});
        expect_lawful(exact.diffuse, lanes.diffuse[i], peak, angles, model.name);
        expect_lawful(exact.specular, lanes.specular[i], peak, angles, model.name);
        expect_lawful(exact.white, lanes.white[i], peak, angles, model.name);
        // Where valleys begin to hide, within 0.01 degrees of grazing, 1 − erf has lost digits.
        expect_lawful(exact.fresnel, lanes.fresnel[i], peak, angles, model.name,
                      model.traits & models::diffracting ? 1e-4 : 2e-6);
        EXPECT_EQ(exact.cosine, double(lanes.cosine[i])) << model.name;
      }
    }
  }
}

/// The same for one kind of parts: `f64` and `f32` evaluate one of them.
template <class F64, class F32>
void expect_lawful_parts(Kind kind, F64 f64, F32 f32) {
  for (const Entry& part : models::registry(kind)) {
    Random random;
    for (int batch = 0; batch < batches && !::testing::Test::HasFailure(); ++batch) {
      auto parameters = random.parameters(part);
      if (kind == Kind::attenuation) parameters[0] = std::pow(10, random.between(-3, 0));
      const auto parameters32 = extremes::single(parameters);
      std::copy(parameters32.begin(), parameters32.end(), parameters.begin());
      const Points at = points(random);
      const Floats lanes = f32(part.index, parameters32, at.f32);
      for (int i = 0; i < lane_count; ++i) {
        const auto& angles = at.f64[static_cast<std::size_t>(i)];
        expect_lawful(f64(part.index, parameters, angles), lanes[i],
                      f64(part.index, parameters, mirrored(angles)), angles, part.name);
      }
    }
  }
}

TEST(Laws, SlopesAreFiniteAndNotNegativeAndF32AgreesWithF64) {
  expect_lawful_parts(
      Kind::slope,
      [](unsigned char index, const auto& parameters, const auto& angles) {
        return models::slope(static_cast<models::Slope>(index), parameters, angles);
      },
      [](unsigned char index, const auto& parameters, const auto& angles) {
        return models::slope(static_cast<models::Slope>(index), parameters, angles);
      });
}

TEST(Laws, AttenuationsAreFiniteAndNotNegativeAndF32AgreesWithF64) {
  expect_lawful_parts(
      Kind::attenuation,
      [](unsigned char index, const auto& parameters, const auto& angles) {
        return models::attenuation(static_cast<models::Attenuation>(index), parameters[0], angles);
      },
      [](unsigned char index, const auto& parameters, const auto& angles) {
        return models::attenuation(static_cast<models::Attenuation>(index), parameters[0], angles);
      });
}

TEST(Laws, DiffuseTermsAreFiniteAndNotNegativeAndF32AgreesWithF64) {
  expect_lawful_parts(
      Kind::diffuse,
      [](unsigned char index, const auto& parameters, const auto& angles) {
        return models::diffuse(static_cast<models::DiffuseTerm>(index), parameters, angles);
      },
      [](unsigned char index, const auto& parameters, const auto& angles) {
        return models::diffuse(static_cast<models::DiffuseTerm>(index), parameters, angles);
      });
}

TEST(Laws, EachLaneIsItsOwn) {
  for (const Entry& model : models::registry(Kind::model)) {
    Random random;
    const auto reflection = extremes::single(random.reflection(model));
    const Points at = points(random);
    const auto together = models::evaluate(reflection, at.f32);
    for (int i = 0; i < lane_count; ++i) {
      Angles<Floats> one = at.f32;
      for (Floats* lanes : {&one.n_dot_l, &one.n_dot_v, &one.n_dot_h, &one.v_dot_h, &one.r_dot_v,
                            &one.n_l_versine, &one.n_v_versine, &one.n_h_versine, &one.r_v_versine,
                            &one.azimuth, &one.tangent, &one.bitangent, &one.solid_angle})
        *lanes = broadcast((*lanes)[i]);
      const auto alone = models::evaluate(reflection, one);
      EXPECT_EQ(alone.diffuse[7 - i], together.diffuse[i]) << model.name;
      EXPECT_EQ(alone.specular[7 - i], together.specular[i]) << model.name;
      EXPECT_EQ(alone.white[7 - i], together.white[i]) << model.name;
      EXPECT_EQ(alone.fresnel[7 - i], together.fresnel[i]) << model.name;
    }
  }
}

TEST(Laws, ALightBehindTheSurfaceGivesNothing) {
  for (const Entry& model : models::registry(Kind::model)) {
    if (model.traits & models::has_ambient) continue;
    Random random;
    for (int i = 0; i < 1000; ++i) {
      auto angles = points(random).f64[0];
      angles.n_dot_l = 0;
      const auto lobes = models::evaluate(random.reflection(model), angles);
      ASSERT_EQ(lobes.diffuse + lobes.specular + lobes.white + lobes.fresnel, 0) << model.name;
    }
  }
}

}  // namespace
}  // namespace metamer::laws
