// What a spectrum is, against the CIE's published values.
#include "client/tools/spectra/spectrum_facts.h"

#include <gtest/gtest.h>

#include <cmath>

namespace metamer::client {
namespace {

EmissionFacts light_facts(const Spectrum& light) {
  const LoadedSpectrum one{"", "", Quantity::emission, light};
  return std::get<EmissionFacts>(
      spectrum_facts(one, *cie::illuminant("D65"), cie::observer_1931())->look);
}

ReflectanceFacts paint_facts(const Spectrum& paint, const Spectrum& light) {
  const LoadedSpectrum one{"", "", Quantity::reflectance, paint};
  return std::get<ReflectanceFacts>(spectrum_facts(one, light, cie::observer_1931())->look);
}

TEST(SpectrumFacts, IlluminantsAreThePublishedOnes) {
  // CIE 15:2004, table T.3, and ASTM E308's five digits: x, y of both observers; T.8 for the rest.
  // D50's table has three digits only.
  struct Published {
    const char* name;
    double x, y, x10, y10, kelvin, ra;
  };
  for (const Published& one : {Published{"A", 0.44757, 0.40745, 0.45117, 0.40594, 2856, 100},
                               Published{"D65", 0.31272, 0.32903, 0.31382, 0.33100, 6503, 100},
                               Published{"D50", 0.34567, 0.35851, 0.34773, 0.35952, 5003, 100},
                               Published{"F2", 0.37208, 0.37529, 0.37925, 0.36733, 4230, 64},
                               Published{"F4", 0.44018, 0.40329, 0.44920, 0.39074, 2940, 51},
                               Published{"F11", 0.38052, 0.37713, 0.38541, 0.37123, 4000, 83}}) {
    const EmissionFacts facts = light_facts(*cie::illuminant(one.name));
    EXPECT_NEAR(facts.observed[0].chromaticity->x, one.x, 6e-5) << one.name;
    EXPECT_NEAR(facts.observed[0].chromaticity->y, one.y, 6e-5) << one.name;
    EXPECT_NEAR(facts.observed[1].chromaticity->x, one.x10, 6e-5) << one.name;
    EXPECT_NEAR(facts.observed[1].chromaticity->y, one.y10, 6e-5) << one.name;
    EXPECT_NEAR(facts.temperature->kelvin, one.kelvin, 10) << one.name;
    EXPECT_NEAR(facts.rendering->ra, one.ra, 0.6) << one.name;
  }
}

TEST(SpectrumFacts, LuminanceIsTheSumOfEnergyByTheEye) {
  // Σ ȳ of the 1931 observer by 1 nm is 106.857, of the 1964 observer 116.66 (CIE 15:2004).
  Spectrum equal;
  for (int nm = 360; nm <= 830; ++nm) {
    equal.nm.push_back(nm);
    equal.values.push_back(2);
  }
  const EmissionFacts facts = light_facts(equal);
  EXPECT_NEAR(facts.observed[0].luminance, 2 * 106.857, 0.01);
  EXPECT_NEAR(facts.observed[1].luminance, 2 * 116.66, 0.1);
  EXPECT_NEAR(facts.observed[0].chromaticity->x, 1. / 3, 1e-4);
}

TEST(SpectrumFacts, OfASodiumLampIsItsIntegral) {
  // The two samples are the ends of the light, and no cells reach beyond them: Simpson's rule is
  // exact.
  EXPECT_NEAR(light_facts({{589.0, 589.6}, {1, 0.5}}).observed[0].luminance, 0.344659738, 1e-6);
  // One sample is a line of that power: ȳ of 546 nm is 0.9841 (Sprague), of 547 nm 0.9875.
  EXPECT_NEAR(light_facts({{546.5}, {2}}).observed[0].luminance, 0.98413 + 0.98747, 1e-4);
}

TEST(SpectrumFacts, WhatNoBlackBodyIsLikeHasNoTemperature) {
  const EmissionFacts dark = light_facts({{400, 700}, {0, 0}});
  EXPECT_FALSE(dark.observed[0].chromaticity);
  EXPECT_FALSE(dark.temperature);
  EXPECT_FALSE(dark.rendering);
  const EmissionFacts green = light_facts({{530}, {1e-300}});
  EXPECT_TRUE(green.observed[0].chromaticity);
  EXPECT_FALSE(green.temperature);
}

TEST(SpectrumFacts, AGreyIsItsShareOfWhiteUnderAnyLight) {
  for (const char* light : {"A", "D65", "F11"}) {
    const ReflectanceFacts facts = paint_facts({{550}, {0.184}}, *cie::illuminant(light));
    EXPECT_NEAR(facts.luminance, 0.184, 1e-13) << light;
    EXPECT_NEAR(facts.lab->l, 116 * std::cbrt(0.184) - 16, 1e-10) << light;
    EXPECT_NEAR(facts.lab->a, 0, 1e-10) << light;
    EXPECT_NEAR(facts.lab->b, 0, 1e-10) << light;
  }
}

TEST(SpectrumFacts, BlackHasNoChromaticityAndADarkLightNoWhite) {
  const ReflectanceFacts black = paint_facts({{550}, {0}}, *cie::illuminant("D65"));
  EXPECT_FALSE(black.chromaticity);
  EXPECT_EQ(black.lab->l, 0);
  const ReflectanceFacts unlit = paint_facts({{550}, {1}}, {{400, 700}, {0, 0}});
  EXPECT_EQ(unlit.luminance, 0);
  EXPECT_FALSE(unlit.lab);
  // A line at 700 nm has no Z to speak of, and none where the table of z̄ is 0.
  EXPECT_FALSE(paint_facts({{550}, {1}}, {{700}, {1}}).lab);
}

TEST(SpectrumFacts, TheRangeIsThatOfTheData) {
  const LoadedSpectrum one{"", "", Quantity::emission, {{380, 500.5, 9000}, {3, -1, 7}}};
  const SpectrumFacts facts = *spectrum_facts(one, *cie::illuminant("A"), cie::observer_1964());
  EXPECT_EQ(facts.from, 380);
  EXPECT_EQ(facts.to, 9000);
  EXPECT_EQ(facts.samples, 3u);
  EXPECT_EQ(facts.min, -1);
  EXPECT_EQ(facts.max, 7);
}

}  // namespace
}  // namespace metamer::client
