// The lights of the table by themselves: closed forms in f64, and eight lanes of f32 against f64.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "common/lights/reference.h"
#include "server/cpu/shared_source.h"

namespace metamer::lights {
namespace {

using Kind = Parameter::Kind;
constexpr double degree = std::numbers::pi / 180;

double versine(double radians) { return 2 * std::pow(std::sin(radians / 2), 2); }

/// A spot at the origin that shines along −z.
Values<double> spot(double half_angle, double penumbra, double reference_distance = 0) {
  return {reference_distance * reference_distance,
          0,
          0,
          0,
          0,
          0,
          -1,
          versine(half_angle * degree),
          penumbra};
}

/// The point at so many radians from the axis.
Eigen::Vector3d off_axis(double radians, double distance = 1) {
  return distance * Eigen::Vector3d(std::sin(radians), 0, -std::cos(radians));
}

double weight(const Values<double>& values, double radians) {
  return incident(Light::spot, values, off_axis(radians)).weight;
}

TEST(Spot, OnItsAxisItIsAPointLight) {
  for (const double half_angle : {0.1, 30.0, 90.0})
    for (const double penumbra : {0.0, 0.3, 1.0})
      for (const double reference : {0.0, 1e-6, 2.0})
        for (const double distance : {1e-100, 1e-6, 1.0, 1e15}) {
          const auto point = incident(Light::point, {reference * reference}, off_axis(0, distance));
          const auto own =
              incident(Light::spot, spot(half_angle, penumbra, reference), off_axis(0, distance));
          EXPECT_EQ(own.weight, point.weight);
          EXPECT_EQ(own.reach, point.reach);
          EXPECT_TRUE(own.direction == point.direction);
        }
}

TEST(Spot, TheEdgeIsASmoothStepInTheCosine) {
  for (const double half_angle : {0.1, 5.0, 30.0, 90.0})
    for (const double penumbra : {0.01, 0.3, 1.0}) {
      const Values<double> values = spot(half_angle, penumbra);
      const double outer = std::cos(half_angle * degree);
      const double inner = outer + penumbra * (1 - outer);
      // Half of the light is left half the way between the cosines.
      EXPECT_NEAR(weight(values, std::acos((inner + outer) / 2)), 0.5, 1e-7);
      double last = 1;
      for (int i = 0; i <= 1000; ++i) {
        const double angle = 1.2 * half_angle * degree * i / 1000;
        const double t = std::clamp((std::cos(angle) - outer) / (inner - outer), 0.0, 1.0);
        const double w = weight(values, angle);
        ASSERT_NEAR(w, t * t * (3 - 2 * t), 1e-6) << half_angle << " " << penumbra;
        ASSERT_LE(w, last);        // It falls,
        ASSERT_LT(last - w, 0.4);  // and does not jump: the steepest edge takes four steps.
        last = w;
      }
      EXPECT_EQ(last, 0);
    }
}

TEST(Spot, WithoutAPenumbraTheEdgeIsAStep) {
  const Values<double> values = spot(30, 0);
  EXPECT_EQ(weight(values, 30 * degree - 1e-9), 1);
  EXPECT_EQ(weight(values, 30 * degree + 1e-9), 0);
}

TEST(Spot, BehindItIsDark) {
  EXPECT_EQ(weight(spot(90, 1), std::numbers::pi), 0);
  EXPECT_EQ(weight(spot(90, 1), 100 * degree), 0);
}

TEST(Lights, AtThePlaceOfALightNothingIsAsked) {
  // No direction; a backend leaves out what has no finite weight or no part towards the light.
  for (const Entry& entry : registry()) {
    if (!is_local(entry) || entry.has_area) continue;
    const auto light = static_cast<Light>(entry.index);
    const auto there = incident(light, spot(30, 0.3, 1), {0, 0, 0});
    EXPECT_FALSE(there.weight <= 3.4e38) << entry.name;
    EXPECT_FALSE(incident(light, spot(30, 0.3), {0, 0, 0}).direction.x() > 0) << entry.name;
  }
}

/// A light of a line, drawn at random, and the same in lanes.
struct Drawn {
  Values<double> f64{};
  Values<Floats> f32{};
};

Drawn draw(const Entry& entry, std::mt19937& engine) {
  std::uniform_real_distribution<double> random(-1, 1);
  const auto rounded = [](double value) { return double{static_cast<float>(value)}; };
  Drawn drawn;
  double* to = drawn.f64.data();
  *to++ = rounded(std::max(0.0, random(engine)));
  for (const Parameter& one : entry.parameters) {
    Eigen::Vector3d v(random(engine), random(engine), random(engine));
    if (one.kind == Kind::direction) v.normalize();
    const double share = (random(engine) + 1) / 2, value = one.min + share * (one.max - one.min);
    if (value_count(one.kind) == 3)
      for (const double part : v) *to++ = rounded(part);
    else
      *to++ = rounded(one.kind == Kind::angle ? versine(value * degree) : value);
  }
  for (std::size_t i = 0; i < drawn.f64.size(); ++i)
    drawn.f32[i] = broadcast(static_cast<float>(drawn.f64[i]));
  return drawn;
}

TEST(Lights, EightLanesAreTheReference) {
  std::mt19937 engine(2004);
  std::uniform_real_distribution<float> random(-2, 2);
  for (const Entry& entry : registry())
    for (int round = 0; round < 2000 && !entry.has_area; ++round) {
      const Drawn drawn = draw(entry, engine);
      const std::array<float, 3> at = {random(engine), random(engine), random(engine)};
      const auto light = static_cast<Light>(entry.index);
      const auto expected = incident(light, drawn.f64, {at[0], at[1], at[2]});
      const auto lanes = cpu::shared::incident(light, drawn.f32, broadcast(at));
      for (int lane = 0; lane < lane_count; lane += 7) {
        const Eigen::Vector3d direction(lanes.direction.x[lane], lanes.direction.y[lane],
                                        lanes.direction.z[lane]);
        EXPECT_LT((direction - expected.direction).norm(), 5e-7) << entry.name;
        // Where the edge of a cone is nearly sharp rounding decides.
        const double full = std::max(1.0, drawn.f64[0] / (expected.reach * expected.reach));
        if (entry.parameters.size() < 4 || drawn.f64[8] > 0.05) {
          EXPECT_NEAR(lanes.weight[lane], expected.weight, 1e-3 * full) << entry.name;
        }
        EXPECT_NEAR(lanes.reach[lane] / expected.reach, 1, 1e-6) << entry.name;
      }
    }
}

}  // namespace
}  // namespace metamer::lights
