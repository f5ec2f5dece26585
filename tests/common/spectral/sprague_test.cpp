#include "common/spectral/sprague.h"

#include <gtest/gtest.h>

#include <cmath>

namespace metamer {
namespace {

Spectrum sampled(double from, double step, std::size_t count, double (*f)(double)) {
  Spectrum result;
  for (std::size_t i = 0; i < count; ++i) {
    result.nm.push_back(from + static_cast<double>(i) * step);
    result.values.push_back(f(result.nm.back()));
  }
  return result;
}

TEST(Sprague, IsExactForPolynomialsOfTheFourthDegree) {
  const auto quartic = [](double nm) {
    const double x = (nm - 500) / 100;
    return 1 + x * (-2 + x * (0.5 + x * (3 - 2 * x)));
  };
  const Spectrum fine = *sprague(sampled(400, 20, 11, quartic), 1.25);
  ASSERT_EQ(fine.nm.size(), 161u);
  // Beyond 440 to 560 nm, samples are used that there are none of.
  for (std::size_t i = 32; i <= 128; ++i)
    EXPECT_NEAR(fine.values[i], quartic(fine.nm[i]), 1e-11) << fine.nm[i];
}

TEST(Sprague, IsExactForStraightLinesToTheirEnds) {
  const auto line = [](double nm) { return 3 - nm / 200; };
  const Spectrum fine = *sprague(sampled(400, 20, 6, line), 1);
  ASSERT_EQ(fine.nm.size(), 101u);
  for (std::size_t i = 0; i < fine.nm.size(); ++i)
    EXPECT_NEAR(fine.values[i], line(fine.nm[i]), 1e-13) << fine.nm[i];
}

TEST(Sprague, HasTheDerivativesOfFivePointsAtItsSamples) {
  // Hermite's quintic from 50 to 60 nm with those derivatives, its equations solved in numpy.
  const Spectrum rough = {{10, 20, 30, 40, 50, 60, 70, 80}, {1, 0, 2, 5, 3, -1, 0, 4}};
  const Spectrum fine = *sprague(rough, 2.5);
  EXPECT_NEAR(fine.values[17], 1.9459228515625, 1e-12) << fine.nm[17];
  EXPECT_NEAR(fine.values[18], 0.75390625, 1e-12) << fine.nm[18];
}

TEST(Sprague, KeepsTheSamplesToTheBit) {
  const Spectrum rough = sampled(380, 5, 81, [](double nm) { return std::sin(nm) + 1 / nm; });
  for (const double step : {1.0, 0.1, 2.5}) {
    const Spectrum fine = *sprague(rough, step);
    for (std::size_t i = 0; i < rough.nm.size(); ++i)
      EXPECT_EQ(
          fine.values[static_cast<std::size_t>(std::lround(5 * static_cast<double>(i) / step))],
          rough.values[i])
          << rough.nm[i] << " by " << step;
  }
}

TEST(Sprague, RefusesWhatIsNotUniformOrTooShort) {
  const auto message = [](const Spectrum& spectrum, double step) {
    return sprague(spectrum, step).error().message;
  };
  EXPECT_EQ(message({{1, 2, 3, 4, 5}, {1, 1, 1, 1, 1}}, 1),
            "Sprague's interpolation takes 6 samples at least, not 5");
  EXPECT_EQ(message({{1, 2, 3, 4.5, 5, 6}, {1, 1, 1, 1, 1, 1}}, 1),
            "Sprague's interpolation takes samples at even distances; 4.5 nm is not at one");
  EXPECT_EQ(message({{1, 2, 3, 4, 5, 6}, {1, 1, 1, 1, 1, 1}}, 0),
            "the step must be above 0 nm, not 0");
}

}  // namespace
}  // namespace metamer
