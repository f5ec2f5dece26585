#include "common/spectral/spectrum.h"

#include <gtest/gtest.h>

#include <limits>

namespace metamer {
namespace {

const Spectrum ramp = {.nm = {400, 500, 700}, .values = {0.1, 0.3, 0.7}};

std::string error_of(std::vector<double> nm, std::vector<double> values) {
  const auto result = make_spectrum(std::move(nm), std::move(values));
  return result ? "no error" : result.error().message;
}

TEST(Spectrum, MustBeWellFormed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of({}, {}), "no wavelengths");
  EXPECT_EQ(error_of({400, 500}, {1}), "2 wavelengths but 1 values");
  EXPECT_EQ(error_of({500, 400}, {1, 1}), "wavelengths must rise: 400 follows 500");
  EXPECT_EQ(error_of({500, 500}, {1, 1}), "wavelength 500 is repeated");
  EXPECT_EQ(error_of({0, 500}, {1, 1}), "wavelength 0 must be above 0 nm");
  EXPECT_EQ(error_of({400, nan}, {1, 1}), "wavelength nan is not finite");
  EXPECT_EQ(error_of({400, 500}, {1, nan}), "the value at 500 nm is not finite");
  EXPECT_EQ(error_of({400, 500}, {1, -1}), "no error");
}

TEST(Resample, IsExactAtTheSamples) {
  const Resampled result = resample(ramp, ramp.nm, Outside::zero);
  EXPECT_EQ(result.values, ramp.values);
  EXPECT_EQ(result.below, 0U);
  EXPECT_EQ(result.above, 0U);
}

TEST(Resample, IsAStraightLineBetweenThem) {
  const Resampled result = resample(ramp, {425, 450, 600}, Outside::zero);
  EXPECT_NEAR(result.values[0], 0.15, 1e-15);
  EXPECT_NEAR(result.values[1], 0.2, 1e-15);
  EXPECT_NEAR(result.values[2], 0.5, 1e-15);
}

TEST(Resample, OutsideAnEmissionIsDarkAndAPropertyKeepsItsEnd) {
  const std::vector<double> nm = {398, 399, 400, 700, 701};
  const Resampled light = resample(ramp, nm, Outside::zero);
  EXPECT_EQ(light.values, (std::vector<double>{0, 0, 0.1, 0.7, 0}));
  EXPECT_EQ(light.below, 2U);
  EXPECT_EQ(light.above, 1U);
  const Resampled paint = resample(ramp, nm, Outside::hold);
  EXPECT_EQ(paint.values, (std::vector<double>{0.1, 0.1, 0.1, 0.7, 0.7}));
  EXPECT_EQ(paint.below, 2U);
  EXPECT_EQ(paint.above, 1U);
}

TEST(Resample, ASingleSampleIsALineOrAConstant) {
  const Spectrum single = {.nm = {589}, .values = {2}};
  EXPECT_EQ(resample(single, {588, 589, 590}, Outside::zero).values,
            (std::vector<double>{0, 2, 0}));
  const Resampled held = resample(single, {588, 589, 590}, Outside::hold);
  EXPECT_EQ(held.values, (std::vector<double>{2, 2, 2}));
  EXPECT_EQ(held.below, 1U);
  EXPECT_EQ(held.above, 1U);
}

TEST(Spectrum, IsRefusedWhereItsSumsAreLost) {
  // f64 ends at 1.8e308, and 1 / x is finite down to 5.6e-309 (IEEE 754).
  const auto fault = [](std::vector<double> values) {
    const auto made = make_spectrum({400, 500, 600}, std::move(values));
    return made ? std::string() : made.error().message;
  };
  EXPECT_EQ(fault({1, 1e308, 1e308}),
            "the value at 500 nm, 1e+308, is too large: at most 1e+100 can be summed");
  EXPECT_EQ(fault({1, 1, -1e101}),
            "the value at 600 nm, -1e+101, is too large: at most 1e+100 can be summed");
  EXPECT_EQ(fault({0, 5e-324, 1e-310}),
            "the largest value, 1e-310, is too small: at least 1e-100 can be summed");
  EXPECT_EQ(fault({0, 5e-324, 1}), "");
  EXPECT_EQ(fault({0, 0, 0}), "");
  EXPECT_EQ(fault({-1e100, 1e-100, 1e100}), "");
}

TEST(Resample, DoesNotOverflowBetweenHugeValues) {
  const double huge = std::numeric_limits<double>::max();
  const Spectrum steep = {.nm = {400, 500}, .values = {-huge, huge}};
  EXPECT_EQ(resample(steep, {450}, Outside::zero).values, std::vector<double>{0});
}

TEST(Resample, TakesNoPositions) { EXPECT_TRUE(resample(ramp, {}, Outside::zero).values.empty()); }

}  // namespace
}  // namespace metamer
