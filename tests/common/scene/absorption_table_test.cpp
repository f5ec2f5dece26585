#include "common/scene/absorption_table.h"

#include <gtest/gtest.h>

#include <cmath>

namespace metamer {
namespace {

TEST(AbsorptionTable, ALineBetweenTwoNodesIsRightToTwo1e5thForEveryDepth) {
  // α of every size, in the middles between nodes, where lines are off most.
  double worst = 0;
  for (double alpha = 1; alpha > 1e-7; alpha *= 0.83)
    for (std::uint32_t i = 0; i + 1 < absorption_nodes; ++i) {
      const double from = absorption_node(i), to = absorption_node(i + 1);
      const double line = (std::exp(-alpha * from) + std::exp(-alpha * to)) / 2;
      worst = std::max(worst, std::abs(line - std::exp(-alpha * (from + to) / 2)));
    }
  EXPECT_LT(worst, 2e-5);
  EXPECT_GT(worst, 1e-5) << "fewer nodes would do";
}

TEST(AbsorptionTable, APlaceIsBetweenItsNodes) {
  for (const double length : {0.0, 1e-30, 1e-6, 0.01, 0.3, 1.9999, 2.0, 2.0001, 7.0, 500.0, 1e7}) {
    const AbsorptionPlace place = absorption_place(static_cast<float>(length));
    const double from = absorption_node(place.below), to = absorption_node(place.below + 1);
    EXPECT_NEAR(from + double{place.fraction} * (to - from), length, 1e-6 * (length + 1e-3));
    EXPECT_GE(place.fraction, -1e-5f);
    EXPECT_LE(place.fraction, 1 + 1e-5f);
  }
  // Beyond its end all but the weakest absorption is complete.
  EXPECT_EQ(absorption_place(3e38f).below, absorption_nodes - 2);
  EXPECT_EQ(absorption_place(3e38f).fraction, 1);
  EXPECT_LT(std::exp(-1e-6 * absorption_node(absorption_nodes - 1)), 1e-5);
}

TEST(AbsorptionTable, DepthsAreRelativeToTheStrongest) {
  const Spectrum transmittance{{400, 500, 600}, {0.25, 0.5, 1}};
  EXPECT_DOUBLE_EQ(optical_depth(transmittance), std::log(4));
  const std::vector<double> depth = relative_depth(transmittance, {400, 450, 500, 600, 700});
  EXPECT_DOUBLE_EQ(depth[0], 1);
  EXPECT_DOUBLE_EQ(depth[1], std::log(1 / 0.375) / std::log(4)) << "T is a line between samples";
  EXPECT_DOUBLE_EQ(depth[2], 0.5);
  EXPECT_EQ(depth[3], 0);
  EXPECT_EQ(depth[4], 0);
  EXPECT_DOUBLE_EQ(optical_depth({{400, 500}, {0, 1}}), -std::log(1e-30));
  EXPECT_EQ(optical_depth({{550}, {1}}), 0);
}

}  // namespace
}  // namespace metamer
