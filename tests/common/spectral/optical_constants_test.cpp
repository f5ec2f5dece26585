#include "common/spectral/optical_constants.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace metamer {
namespace {

const Medium& medium(const std::string& name) {
  for (const Medium& one : media())
    if (one.name == name) return one;
  throw std::invalid_argument(name);
}

double index(const std::string& name, double nm) {
  return std::sqrt(sellmeier_squared(medium(name).terms, nm));
}

/// The Abbe number, of the yellow d, blue F and red C lines of helium and hydrogen.
double abbe(const std::string& name) {
  return (index(name, 587.5618) - 1) / (index(name, 486.1327) - index(name, 656.2725));
}

TEST(OpticalConstants, GlassesHaveTheIndexAndTheAbbeNumberOfTheirCatalogue) {
  EXPECT_NEAR(index("N-BK7", 587.5618), 1.5168, 5e-6);
  EXPECT_NEAR(abbe("N-BK7"), 64.17, 5e-3);
  EXPECT_NEAR(index("N-SF11", 587.5618), 1.78472, 5e-6);
  EXPECT_NEAR(abbe("N-SF11"), 25.68, 5e-3);
}

TEST(OpticalConstants, WaterAndDiamondRefractAsKnown) {
  EXPECT_NEAR(index("water", 589.3), 1.333, 5e-4);
  EXPECT_NEAR(index("diamond", 589.3), 2.417, 1e-3);
}

TEST(OpticalConstants, EveryMetalIsAPairOfSoundSpectraOverTheVisibleRange) {
  for (const Metal& metal : metals()) {
    EXPECT_TRUE(make_spectrum(metal.n.nm, metal.n.values)) << metal.name;
    EXPECT_EQ(metal.n.nm, metal.k.nm) << metal.name;
    EXPECT_EQ(metal.k.nm.size(), metal.k.values.size()) << metal.name;
    EXPECT_LE(metal.n.nm.front(), 300) << metal.name;
    EXPECT_GE(metal.n.nm.back(), 800) << metal.name;
  }
}

TEST(OpticalConstants, GoldIsYellowAndSilverIsNot) {
  // E[2.2-8] at normal incidence: ((n−1)² + k²)/((n+1)² + k²).
  const auto reflectance = [](const Metal& metal, double nm) {
    const double n = resample(metal.n, {nm}, Outside::hold).values[0];
    const double k = resample(metal.k, {nm}, Outside::hold).values[0];
    return ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
  };
  const Metal &silver = metals()[0], &aluminium = metals()[1], &gold = metals()[2];
  EXPECT_LT(reflectance(gold, 450), 0.45);
  EXPECT_GT(reflectance(gold, 650), 0.95);
  EXPECT_GT(reflectance(silver, 450), 0.97);
  EXPECT_NEAR(reflectance(aluminium, 550), 0.91, 0.02);
}

TEST(OpticalConstants, CauchysFormulaIsInMicrometres) {
  EXPECT_DOUBLE_EQ(cauchy(1.5, 0.004, 0.0001, 500), 1.5 + 0.004 / 0.25 + 0.0001 / 0.0625);
}

}  // namespace
}  // namespace metamer
