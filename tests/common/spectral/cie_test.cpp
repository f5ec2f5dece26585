#include "common/spectral/cie.h"

#include <gtest/gtest.h>

#include <cmath>

namespace metamer {
namespace {

double value_at(const Spectrum& spectrum, double nm) {
  return resample(spectrum, {nm}, Outside::zero).values.front();
}

TEST(CieTables, AreAllThere) {
  EXPECT_EQ(cie::illuminant_names(),
            (std::vector<std::string>{"A",   "B",  "C",  "D50", "D55", "D65", "D75",
                                      "D93", "E",  "F1", "F2",  "F3",  "F4",  "F5",
                                      "F6",  "F7", "F8", "F9",  "F10", "F11", "F12"}));
  ASSERT_EQ(cie::test_color_names().size(), 15U);
  EXPECT_EQ(cie::test_color_names().front(), "TCS01");
  EXPECT_EQ(cie::test_color_names().back(), "TCS15");
  EXPECT_EQ(cie::illuminant("d65"), nullptr);
  EXPECT_EQ(cie::illuminant(""), nullptr);
  EXPECT_EQ(cie::test_color("TCS16"), nullptr);
}

TEST(CieTables, AreSoundSpectra) {
  for (const std::string& name : cie::illuminant_names()) {
    const Spectrum& light = *cie::illuminant(name);
    ASSERT_TRUE(make_spectrum(light.nm, light.values)) << name;
    for (const double value : light.values) EXPECT_GE(value, 0) << name;
  }
  for (const std::string& name : cie::test_color_names()) {
    const Spectrum& paint = *cie::test_color(name);
    ASSERT_TRUE(make_spectrum(paint.nm, paint.values)) << name;
    ASSERT_EQ(paint.nm.front(), 360) << name;
    ASSERT_EQ(paint.nm.back(), 830) << name;
    for (const double value : paint.values) EXPECT_TRUE(value >= 0 && value <= 1) << name;
  }
}

TEST(CieTables, OfTheObserversHoldThePublishedValues) {
  // CIE 15, tables T.4 and T.5.
  const auto& two = cie::observer_1931().functions();
  EXPECT_EQ(value_at(two[0], 600), 1.0622);
  EXPECT_EQ(value_at(two[1], 555), 1.0);
  EXPECT_EQ(value_at(two[2], 445), 1.7826);
  EXPECT_EQ(two[0].nm.front(), 360);
  EXPECT_EQ(two[0].nm.back(), 830);
  const auto& ten = cie::observer_1964().functions();
  EXPECT_EQ(value_at(ten[0], 595), 1.1343);
  EXPECT_EQ(value_at(ten[1], 555), 0.99911);
  EXPECT_EQ(value_at(ten[2], 445), 2.0273);
}

TEST(CieTables, OfTheObserversComeNearThePublishedOnesBy1Nm) {
  // ISO 11664-1 (CIE S 014-1), the 1931 observer; Sprague's interpolation of every fifth value.
  struct Row {
    double nm;
    std::array<double, 3> xyz;
  };
  const auto& two = cie::observer_1931().functions();
  for (const Row& row : std::vector<Row>{{453, {0.3266357, 0.04376600, 1.7589438}},
                                         {466, {0.2408475, 0.07701600, 1.4861114}},
                                         {471, {0.1842136, 0.09491755, 1.2374223}},
                                         {503, {0.002424880, 0.3716986, 0.2347718}},
                                         {518, {0.04798504, 0.6708752, 0.08998272}},
                                         {534, {0.2133658, 0.9054432, 0.03208872}},
                                         {556, {0.5282959, 0.9998567, 0.005303600}},
                                         {577, {0.8730816, 0.8982772, 0.001737800}},
                                         {599, {1.0629096, 0.6438448, 0.0008425600}},
                                         {611, {0.9913675, 0.4904688, 0.0003072533}},
                                         {631, {0.6215149, 0.2547632, 0.00004416}},
                                         {688, {0.02634484, 0.009533311, 0}}})
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(value_at(two[c], row.nm), row.xyz[c], 4e-4) << row.nm << " " << c;
}

TEST(CieTables, OfTheObserversAreNowhereBelow0) {
  for (const auto& observer : {cie::observer_1931(), cie::observer_1964()})
    for (const Spectrum& function : observer.functions()) {
      EXPECT_EQ(function.nm.size(), 471u) << "1 nm";
      for (const double value : function.values) EXPECT_GE(value, 0);
    }
}

TEST(CieTables, OfIlluminantAFollowItsDefinition) {
  // CIE 15, equation 3.1: a Planckian radiator at 2848 K with c2 = 1.435e7 nm·K.
  const auto planck = [](double nm) {
    return std::pow(560 / nm, 5) * std::expm1(1.435e7 / (2848 * 560)) /
           std::expm1(1.435e7 / (2848 * nm));
  };
  const Spectrum& a = *cie::illuminant("A");
  ASSERT_EQ(a.nm.size(), 531U) << "1 nm";
  const double scale = value_at(a, 560);
  for (std::size_t i = 0; i < a.nm.size(); ++i) {
    EXPECT_NEAR(a.values[i] / scale, planck(a.nm[i]), 1e-5 * planck(a.nm[i])) << a.nm[i];
  }
}

TEST(CieTables, OfTheEqualEnergyLightAreEqual) {
  for (const double value : cie::illuminant("E")->values) EXPECT_EQ(value, 1.0);
}

}  // namespace
}  // namespace metamer
