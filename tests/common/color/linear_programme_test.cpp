#include "common/color/linear_programme.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

namespace metamer {
namespace {

/// The largest goal over all corners of a plane's polygon.
double best_corner(const Eigen::Vector2d& goal, const Eigen::MatrixXd& limits,
                   const Eigen::VectorXd& bounds) {
  double best = -1e300;
  for (Eigen::Index i = 0; i < limits.rows(); ++i)
    for (Eigen::Index j = 0; j < i; ++j) {
      Eigen::Matrix2d both;
      both << limits.row(i), limits.row(j);
      if (std::abs(both.determinant()) < 1e-9) continue;
      const Eigen::Vector2d corner = both.inverse() * Eigen::Vector2d(bounds[i], bounds[j]);
      if (((limits * corner - bounds).array() <= 1e-9).all())
        best = std::max(best, goal.dot(corner));
    }
  return best;
}

TEST(LinearProgramme, FindsTheBestCorner) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> side(-1, 1), bound(0, 1);
  for (int round = 0; round < 200; ++round) {
    // Random lines around 0 within a square; some of them through 0 itself.
    Eigen::MatrixXd limits(16, 2);
    Eigen::VectorXd bounds(16);
    for (Eigen::Index i = 0; i < 12; ++i) {
      limits.row(i) << side(random), side(random);
      bounds[i] = i < round % 3 ? 0 : bound(random);
    }
    limits.bottomRows(4) << 1, 0, -1, 0, 0, 1, 0, -1;
    bounds.tail(4).setConstant(2);
    const Eigen::Vector2d goal(side(random), side(random));
    const auto found = maximise(goal, limits, bounds);
    ASSERT_TRUE(found);
    EXPECT_TRUE(((limits * *found - bounds).array() <= 1e-9).all());
    EXPECT_NEAR(goal.dot(*found), best_corner(goal, limits, bounds), 1e-9) << round;
  }
}

TEST(LinearProgramme, WithoutALargestValueHasNone) {
  EXPECT_FALSE(
      maximise(Eigen::Vector2d(1, 0), Eigen::RowVector2d(-1, 0), Eigen::VectorXd::Ones(1)));
}

TEST(LinearProgramme, StaysWhereItCannotMove) {
  Eigen::MatrixXd limits(2, 1);
  limits << 1, -1;
  const auto found = maximise(Eigen::VectorXd::Ones(1), limits, Eigen::VectorXd::Zero(2));
  ASSERT_TRUE(found);
  EXPECT_EQ((*found)[0], 0);
}

}  // namespace
}  // namespace metamer
