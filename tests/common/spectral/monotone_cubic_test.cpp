#include "common/spectral/monotone_cubic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace metamer {
namespace {

const Spectrum uneven = {{400, 410, 425, 430, 450, 480, 490},
                         {0.1, 0.15, 0.6, 0.55, 0.2, 0.25, 0.9}};

TEST(MonotoneCubic, IsTheGnuScientificLibrarys) {
  // gsl_interp_steffen, GSL 2.7. It keeps another slope at the two ends.
  const std::vector<double> nm = {413, 420, 427, 440, 466, 470};
  const std::vector<double> gsl = {0.21599999999999997, 0.49444444444444435, 0.58792,
                                   0.34625000000000006, 0.21422222222222223, 0.22222222222222224};
  const std::vector<double> values = *monotone_cubic(uneven, nm);
  for (std::size_t i = 0; i < nm.size(); ++i) EXPECT_NEAR(values[i], gsl[i], 1e-15) << nm[i];
}

TEST(MonotoneCubic, HasSteffensSlopesAtItsEnds) {
  // numpy, as Hermite's cubic: slopes 0, as the parabola falls there, and 0.0808.
  const std::vector<double> values = *monotone_cubic(uneven, {405, 485});
  EXPECT_NEAR(values[0], 0.1125, 1e-15);
  EXPECT_NEAR(values[1], 0.478125, 1e-15);
}

TEST(MonotoneCubic, StaysBetweenNeighboursAndKeepsTheSamples) {
  Spectrum rough;
  for (int i = 0; i < 60; ++i) {
    rough.nm.push_back(360 + 5 * i + 1.9 * std::sin(i));
    rough.values.push_back(std::pow(std::sin(7.0 * i), 3));
  }
  EXPECT_EQ(*monotone_cubic(rough, rough.nm), rough.values);
  for (std::size_t i = 1; i < rough.nm.size(); ++i) {
    std::vector<double> nm;
    for (int k = 0; k <= 50; ++k)
      nm.push_back(rough.nm[i - 1] + (rough.nm[i] - rough.nm[i - 1]) * k / 50.0);
    nm.back() = rough.nm[i];
    std::vector<double> values = *monotone_cubic(rough, nm);
    if (values.front() > values.back()) std::reverse(values.begin(), values.end());
    for (std::size_t k = 1; k < values.size(); ++k)
      EXPECT_GE(values[k], values[k - 1] - 1e-15) << rough.nm[i];
  }
}

TEST(MonotoneCubic, IsExactForParabolasThatRise) {
  // Steffen's slope is the parabola's where that is no steeper than twice a chord.
  Spectrum samples;
  const auto parabola = [](double nm) { return std::pow(nm / 500, 2); };
  for (const double nm : {400.0, 420.0, 430.0, 455.0, 470.0}) {
    samples.nm.push_back(nm);
    samples.values.push_back(parabola(nm));
  }
  for (double nm = 400; nm <= 470; nm += 0.7)
    EXPECT_NEAR(monotone_cubic(samples, {nm})->front(), parabola(nm), 1e-14) << nm;
}

TEST(MonotoneCubic, RefusesTwoSamples) {
  const Spectrum line = {{400, 500}, {0, 1}};
  EXPECT_EQ(monotone_cubic(line, {450}).error().message,
            "a monotone cubic takes 3 samples at least, not 2");
}

}  // namespace
}  // namespace metamer
