#include "common/spectral/sprague.h"

#include <gtest/gtest.h>

#include <cmath>

namespace metamer {
namespace {

/// From the first sample to the last.
Spectrum by_step(const Spectrum& samples, double step) {
  const std::vector<double> nm =
      Wavelengths::uniform(samples.nm.front(), samples.nm.back(), step)->nm();
  return {nm, *sprague(samples, nm)};
}

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
  const Spectrum fine = by_step(sampled(400, 20, 11, quartic), 1.25);
  ASSERT_EQ(fine.nm.size(), 161u);
  // Beyond 440 to 560 nm, samples are used that there are none of.
  for (std::size_t i = 32; i <= 128; ++i)
    EXPECT_NEAR(fine.values[i], quartic(fine.nm[i]), 1e-11) << fine.nm[i];
}

TEST(Sprague, IsExactForStraightLinesToTheirEnds) {
  const auto line = [](double nm) { return 3 - nm / 200; };
  const Spectrum fine = by_step(sampled(400, 20, 6, line), 1);
  ASSERT_EQ(fine.nm.size(), 101u);
  for (std::size_t i = 0; i < fine.nm.size(); ++i)
    EXPECT_NEAR(fine.values[i], line(fine.nm[i]), 1e-13) << fine.nm[i];
}

TEST(Sprague, HasTheDerivativesOfFivePointsAtItsSamples) {
  // Hermite's quintic from 50 to 60 nm with those derivatives, its equations solved in numpy.
  const Spectrum rough = {{10, 20, 30, 40, 50, 60, 70, 80}, {1, 0, 2, 5, 3, -1, 0, 4}};
  const Spectrum fine = by_step(rough, 2.5);
  EXPECT_NEAR(fine.values[17], 1.9459228515625, 1e-12) << fine.nm[17];
  EXPECT_NEAR(fine.values[18], 0.75390625, 1e-12) << fine.nm[18];
}

TEST(Sprague, KeepsTheSamplesToTheBit) {
  const Spectrum rough = sampled(380, 5, 81, [](double nm) { return std::sin(nm) + 1 / nm; });
  for (const double step : {1.0, 0.1, 2.5}) {
    const Spectrum fine = by_step(rough, step);
    for (std::size_t i = 0; i < rough.nm.size(); ++i)
      EXPECT_EQ(
          fine.values[static_cast<std::size_t>(std::lround(5 * static_cast<double>(i) / step))],
          rough.values[i])
          << rough.nm[i] << " by " << step;
  }
}

TEST(Sprague, IsThatOfColourSciencesDocumentation) {
  // colour.SpragueInterpolator(x, y)([0.25, 0.5, 0.75]), in the stretch that needs both samples
  // before the first.
  const Spectrum samples = {{1, 2, 3, 4, 5, 6, 7},
                            {5.9200, 9.3700, 10.8135, 4.5100, 69.5900, 27.8007, 86.0500}};
  const std::vector<double> values = *sprague(samples, {1.25, 1.5, 1.75});
  EXPECT_NEAR(values[0], 6.7295161, 1e-7);
  EXPECT_NEAR(values[1], 7.2185025, 1e-7);
  EXPECT_NEAR(values[2], 7.8140625, 1e-7);
}

TEST(Sprague, RefusesWhatIsNotUniformOrTooShort) {
  const auto message = [](std::vector<double> nm) {
    const Spectrum samples{nm, nm};
    const auto refused = sprague(samples, {nm.front()});
    EXPECT_EQ(refused.error().message, *sprague_fault(samples));
    return refused.error().message;
  };
  EXPECT_EQ(message({1, 2, 3, 4, 5}), "Sprague's interpolation takes 6 samples at least, not 5");
  EXPECT_EQ(message({1, 2, 3, 4.5, 5, 6}),
            "Sprague's interpolation takes samples at even distances; 4.5 nm is not at one");
}

}  // namespace
}  // namespace metamer
