#include <gtest/gtest.h>

#include <random>

#include "common/models/reference.h"
#include "server/cpu/shared_source.h"

namespace metamer::cpu {
namespace {

TEST(Angles, AreThoseOfTheReference) {
  std::mt19937 engine(3);
  std::normal_distribution<double> random;
  for (int round = 0; round < 1000; ++round) {
    const auto unit = [&] {
      return Eigen::Vector3d(random(engine), random(engine), random(engine)).normalized();
    };
    const Eigen::Vector3d normal = unit(), light = unit(), viewer = unit();
    const Eigen::Vector3d flat = normal.cross(unit()).normalized();
    const auto lanes = [](const Eigen::Vector3d& v) {
      return broadcast(
          {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())});
    };
    // A tangent of any length, and not in the surface.
    const auto angles =
        shared::angles_of(lanes(normal), lanes(3 * flat + 0.5 * normal), lanes(light),
                          lanes(viewer), broadcast(0.25f), true, true);
    const auto expected = models::angles_between(normal, flat, light, viewer, 0.25);
    EXPECT_NEAR(angles.n_dot_l[0], expected.n_dot_l, 1e-6);
    EXPECT_NEAR(angles.n_dot_v[0], expected.n_dot_v, 1e-6);
    EXPECT_NEAR(angles.n_dot_h[0], expected.n_dot_h, 2e-6);
    EXPECT_NEAR(angles.v_dot_h[0], expected.v_dot_h, 2e-6);
    EXPECT_NEAR(angles.r_dot_v[0], expected.r_dot_v, 2e-6);
    EXPECT_NEAR(angles.n_l_versine[0], expected.n_l_versine, 1e-6);
    EXPECT_NEAR(angles.n_v_versine[0], expected.n_v_versine, 1e-6);
    EXPECT_NEAR(angles.n_h_versine[0], expected.n_h_versine, 2e-6);
    EXPECT_NEAR(angles.r_v_versine[0], expected.r_v_versine, 2e-6);
    EXPECT_NEAR(angles.azimuth[0], expected.azimuth, 1e-4);
    EXPECT_NEAR(angles.tangent[0], expected.tangent, 1e-4);
    EXPECT_NEAR(angles.bitangent[0], expected.bitangent, 1e-4);
    EXPECT_EQ(angles.solid_angle[0], 0.25f);
  }
}

TEST(Angles, OfNearlyTheSameVectorsHaveAllTheirDigits) {
  // 2⁻¹² from the mirror direction, in vectors whose lengths miss 1 by a rounding: cosines of 1 −
  // 3e-8 and less, which f32 can't tell from 1.
  const float small = 0x1p-12f, less = 1 - 0x1p-24f, more = 1 + 0x1p-23f;
  const Vectors normal = broadcast({0, 0, less}), light = broadcast({0, 0, more});
  const Vectors viewer = broadcast({small, 0, less}), tangent = broadcast({1, 0, 0});
  const auto angles = shared::angles_of(normal, tangent, light, viewer, broadcast(1), false, false);
  const double angle = std::atan(double(small) / double(less));
  const auto versine = [](double of) { return 2 * std::sin(of / 2) * std::sin(of / 2); };
  EXPECT_NEAR(angles.n_h_versine[0], versine(angle / 2), 2e-6 * versine(angle / 2));
  EXPECT_NEAR(angles.n_v_versine[0], versine(angle), 2e-6 * versine(angle));
  EXPECT_NEAR(angles.r_v_versine[0], versine(angle), 2e-6 * versine(angle));
  EXPECT_LT(angles.n_l_versine[0], 1e-13f);
}

TEST(Angles, WhereLightAndViewerAreOppositeThereIsNoBisector) {
  const auto angles =
      shared::angles_of(broadcast({0, 0, 1}), broadcast({1, 0, 0}), broadcast({0.6f, 0, 0.8f}),
                        broadcast({-0.6f, 0, -0.8f}), broadcast(1), true, true);
  EXPECT_EQ(angles.n_dot_h[0], 0);
  EXPECT_EQ(angles.n_h_versine[0], 1);
  EXPECT_EQ(angles.v_dot_h[0], 0);
  EXPECT_EQ(angles.tangent[0], 1);
  EXPECT_EQ(angles.bitangent[0], 0);
}

TEST(Angles, ATangentAlongTheNormalGivesWayToTheOtherAxis) {
  // All over a face that the tangent pierces, only rounding would be left of it.
  const Vectors normal = broadcast({0.6f, 0.8f, 0}), across = broadcast({0, 0, 1});
  for (const float tilt : {0.0f, 1e-7f, -1e-7f, 0.01f}) {
    const Vectors tangent = broadcast({-1.2f + tilt, -1.6f, tilt});
    EXPECT_EQ(shared::steady_tangent(normal, tangent, across).z[0], 1) << tilt;
  }
  EXPECT_EQ(shared::steady_tangent(normal, broadcast({-0.6f, -0.8f, 0.2f}), across).z[0], 0.2f);
}

}  // namespace
}  // namespace metamer::cpu
