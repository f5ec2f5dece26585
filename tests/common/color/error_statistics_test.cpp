#include "common/color/error_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace metamer {
namespace {

TEST(ErrorStatistics, Of0To100AreThePercentilesThemselves) {
  std::vector<double> errors(101);
  for (std::size_t i = 0; i < errors.size(); ++i)
    errors[i] = static_cast<double>((i * 37) % 101);  // every number once, out of order
  const ErrorStatistics all = error_statistics(errors);
  EXPECT_DOUBLE_EQ(all.mean, 50);
  EXPECT_DOUBLE_EQ(all.median, 50);
  EXPECT_DOUBLE_EQ(all.percentile_95, 95);
  EXPECT_DOUBLE_EQ(all.percentile_99, 99);
  EXPECT_EQ(all.maximum, 100);
  EXPECT_EQ(errors[all.at], 100);
  EXPECT_EQ(all.count, 101u);
}

TEST(ErrorStatistics, LieOnTheLineBetweenNeighbours) {
  // 1, 2, 4, 8: 0.95 · 3 = 2.85, which is 4 + 0.85 · 4; 0.99 · 3 = 2.97.
  const ErrorStatistics all = error_statistics(std::vector<double>{8, 1, 4, 2});
  EXPECT_DOUBLE_EQ(all.median, 3);
  EXPECT_DOUBLE_EQ(all.percentile_95, 7.4);
  EXPECT_DOUBLE_EQ(all.percentile_99, 7.88);
}

TEST(ErrorStatistics, LeaveOutAndPlaceWhatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const ErrorStatistics all = error_statistics(std::vector<double>{1, HUGE_VAL, 3, nan});
  EXPECT_EQ(all.mean, 2);
  EXPECT_EQ(all.maximum, 3);
  EXPECT_EQ(all.at, 2u);
  EXPECT_EQ(all.count, 2u);
  EXPECT_EQ(all.not_finite, 2u);
  EXPECT_EQ(all.first_not_finite, 1u);
}

TEST(ErrorStatistics, OfNothingAndOfZerosAreZero) {
  EXPECT_EQ(error_statistics({}).count, 0u);
  const ErrorStatistics all = error_statistics(std::vector<double>{0, 0});
  EXPECT_EQ(all.maximum, 0);
  EXPECT_EQ(all.at, 0u);
  EXPECT_EQ(error_statistics(std::vector<double>{0.25}).percentile_99, 0.25);
}

}  // namespace
}  // namespace metamer
