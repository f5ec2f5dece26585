// The weights of ASTM E308's table 5 against Lagrange's polynomials in numpy, over 0.1 nm, and what
// they are worth.
#include "common/color/table_weights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <numeric>

#include "common/color/lab.h"

namespace metamer {
namespace {

const Observer& observer = cie::observer_1931();

std::vector<double> bands(double from, double to, double step) {
  return Wavelengths::uniform(from, to, step)->nm();
}

ObserverWeights weights(TableWeights kind, const char* light, const std::vector<double>& nm) {
  return *weights_under(kind, observer, *cie::illuminant(light), nm);
}

TEST(TableWeights, ShowAPaintAsNumpyDoes) {
  struct Row {
    const char *light, *paint;
    double from, to, step;
    Xyz xyz;
  };
  for (const Row& row :
       std::vector<Row>{{"F11", "TCS09", 400, 700, 20, {0.23890692, 0.13205609, 0.026733592}},
                        {"D65", "TCS01", 380, 780, 20, {0.32878986, 0.2979698, 0.24419219}},
                        {"A", "TCS12", 400, 700, 10, {0.038972404, 0.047150223, 0.091866495}}}) {
    const auto nm = bands(row.from, row.to, row.step);
    const Xyz xyz = to_xyz(weights(TableWeights::astm, row.light, nm),
                           resample(*cie::test_color(row.paint), nm, Outside::hold).values);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(xyz[c], row.xyz[c], 1e-5 * row.xyz[c]) << row.light << " " << row.step;
  }
}

TEST(TableWeights, SumToTheWhite) {
  // ASTM E308-01, table 5: X 95.047, Z 108.883 of D65, whatever the bands.
  for (const auto& nm : {bands(360, 780, 20), bands(400, 700, 10)}) {
    const ObserverWeights d65 = weights(TableWeights::astm, "D65", nm);
    const auto sum = [&](std::size_t c) {
      return std::accumulate(d65.weights[c].begin(), d65.weights[c].end(), 0.0);
    };
    EXPECT_NEAR(sum(0), 0.95047, 2e-5);
    EXPECT_NEAR(sum(1), 1, 1e-12);
    EXPECT_NEAR(sum(2), 1.08883, 2e-5);
  }
}

/// Mean and largest ΔE00 of the 14 test colours, sampled and seen with weights, from what they are.
std::pair<double, double> loss(TableWeights kind, const char* light, double step) {
  const auto nm = bands(400, 700, step);
  const std::vector<double>& fine = cie::test_color("TCS01")->nm;
  const ObserverWeights lit = weights(kind, light, nm),
                        whole = weights(TableWeights::lines, light, fine);
  const Xyz white = to_xyz(whole, std::vector<double>(fine.size(), 1.0));
  double sum = 0, most = 0;
  for (std::size_t i = 0; i < 14; ++i) {
    const Spectrum& paint = *cie::test_color(cie::test_color_names()[i]);
    const double off =
        delta_e_00(to_lab(to_xyz(lit, resample(paint, nm, Outside::hold).values), white),
                   to_lab(to_xyz(whole, paint.values), white));
    sum += off;
    most = std::max(most, off);
  }
  return {sum / 14, most};
}

TEST(TableWeights, LoseLessThanStraightLinesAndSpraguesCurve) {
  // Means and maxima by numpy of lines and of Sprague's curve, 400 to 700 nm.
  struct Row {
    const char* light;
    double step;
    std::pair<double, double> lines, sprague;
  };
  for (const Row& row : {Row{"F11", 20, {0.423, 0.700}, {0.254, 0.457}},
                         Row{"F11", 10, {0.215, 0.625}, {0.206, 0.556}},
                         Row{"F2", 20, {0.385, 0.939}, {0.209, 0.383}},
                         Row{"A", 20, {0.356, 0.669}, {0.206, 0.452}}}) {
    const auto lines = loss(TableWeights::lines, row.light, row.step);
    const auto astm = loss(TableWeights::astm, row.light, row.step);
    EXPECT_NEAR(lines.first, row.lines.first, 2e-3) << row.light << " " << row.step;
    EXPECT_NEAR(lines.second, row.lines.second, 2e-3) << row.light << " " << row.step;
    EXPECT_LT(astm.first, row.sprague.first + 4e-3) << row.light << " " << row.step;
    EXPECT_LT(astm.second, row.sprague.second + 4e-3) << row.light << " " << row.step;
    std::printf("%s by %g nm: lines %.3f (at most %.3f), astm %.3f (at most %.3f)\n", row.light,
                row.step, lines.first, lines.second, astm.first, astm.second);
  }
}

TEST(TableWeights, RefuseUnevenAndFewSamples) {
  const auto refusal = [](std::vector<double> nm) {
    return weights_under(TableWeights::astm, observer, *cie::illuminant("A"), nm).error().message;
  };
  EXPECT_EQ(refusal({400, 500, 600}), "ASTM's weights take 4 samples at least, not 3");
  EXPECT_EQ(refusal({400, 420, 440, 470}),
            "ASTM's weights take samples at even distances, not 400 and 420 nm among others");
  EXPECT_EQ(find_table_weights("lines"), TableWeights::lines);
  EXPECT_EQ(find_table_weights("astm"), TableWeights::astm);
  EXPECT_FALSE(find_table_weights("e308"));
}

}  // namespace
}  // namespace metamer
