#include "common/spectral/panels.h"

#include <gtest/gtest.h>

#include <cmath>

namespace metamer {
namespace {

TEST(Panels, ShareTheNodesBetweenThem) {
  const Panels panels{{400, 410, 500}, {2, 1}};
  EXPECT_EQ(panels.nodes(), (std::vector<double>{400, 405, 410, 500}));
}

TEST(Panels, OfADegreeHoldPolynomialsOfIt) {
  for (std::size_t degree = 1; degree <= Panels::max_degree; ++degree) {
    const std::vector<double> nodes = panel_nodes(400, 430, degree);
    ASSERT_EQ(nodes.size(), degree + 1);
    const auto value = [&](double nm) {
      return std::pow((nm - 407) / 10, static_cast<double>(degree));
    };
    for (double nm = 400; nm <= 430; nm += 0.37) {
      const Lagrange worth = lagrange(nm, nodes);
      double sum = 0, all = 0;
      for (std::size_t i = 0; i <= degree; ++i) {
        sum += worth[i] * value(nodes[i]);
        all += worth[i];
      }
      EXPECT_NEAR(sum, value(nm), 1e-12 * std::pow(2.3, degree)) << degree;
      EXPECT_NEAR(all, 1, 1e-14);
    }
  }
}

TEST(Panels, AtANodeAreItsValue) {
  const std::vector<double> nodes = panel_nodes(400, 430, 4);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t j = 0; j < nodes.size(); ++j)
      EXPECT_EQ(lagrange(nodes[i], nodes)[j], i == j ? 1 : 0);
}

}  // namespace
}  // namespace metamer
