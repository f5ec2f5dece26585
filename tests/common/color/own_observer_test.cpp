#include <gtest/gtest.h>

#include <cmath>

#include "common/color/xyz.h"

namespace metamer {
namespace {

/// Matching functions of no eye, at every `step` nm.
Observer smooth_eye(double step) {
  const auto bell = [](double nm, double middle, double width) {
    return std::exp(-std::pow((nm - middle) / width, 2));
  };
  Observer::Functions tables;
  for (double nm = 360; nm <= 830; nm += step) {
    for (Spectrum& table : tables) table.nm.push_back(nm);
    tables[0].values.push_back(0.9 * bell(nm, 600, 38) + 0.3 * bell(nm, 445, 22));
    tables[1].values.push_back(bell(nm, 556, 47));
    tables[2].values.push_back(1.7 * bell(nm, 450, 25));
  }
  return *make_observer("smooth", tables);
}

const Spectrum lamp{{390, 445, 446, 610, 800}, {1, 3, 0.2, 2, 0.5}};
const Spectrum some_paint{{400, 550, 700}, {0.1, 0.7, 0.3}};

void expect_near(const Xyz& xyz, const Xyz& wanted, double relative) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(xyz[i] / wanted[i], 1, relative) << i;
}

// The values are those of numpy: trapz over 0.005 nm of np.interp of the tables above.

TEST(OwnObserver, SeesWhatAPlainSumSays) {
  const Observer eye = smooth_eye(1);
  expect_near(emission_xyz(lamp, eye), {124.4277043963445, 116.18768905058984, 93.71441650106294},
              1e-5);
  const ObserverWeights lit = under_light(eye, lamp, some_paint.nm);
  expect_near(to_xyz(lit, some_paint.values),
              {0.554045195433931, 0.6168990887998604, 0.20916392536196263}, 1e-5);
}

TEST(OwnObserver, OfACoarseTableIsTheSmoothFunctionThatItSamples) {
  // Without straight lines between samples, the functions themselves.
  const Xyz smooth = {124.42981357071027, 116.18802392951483, 93.71239427050457};
  expect_near(emission_xyz(lamp, smooth_eye(1)), smooth, 4e-5);
  expect_near(emission_xyz(lamp, smooth_eye(5)), smooth, 4e-5);
  expect_near(emission_xyz(lamp, smooth_eye(10)), smooth, 2e-4);
}

TEST(OwnObserver, WithXAndZSwappedSeesThemSwapped) {
  for (const Observer& cie : {cie::observer_1931(), cie::observer_1964()}) {
    const auto& [x, y, z] = cie.functions();
    const Observer swapped = *make_observer("swapped", {z, y, x});
    for (const char* light : {"A", "D65", "F11"}) {
      const Xyz right = white_of(*cie::illuminant(light), cie);
      EXPECT_EQ(white_of(*cie::illuminant(light), swapped), (Xyz{right[2], right[1], right[0]}));
    }
  }
}

TEST(OwnObserver, OfOneNarrowLineSeesThatAlone) {
  // 0.4 nm wide, where no whole nanometre is; X and Z are nothing.
  const Spectrum none{{400, 700}, {0, 0}};
  const auto eye = make_observer("narrow", {none, {{555.2, 555.4, 555.6}, {0, 1, 0}}, none});
  ASSERT_TRUE(eye);
  EXPECT_NEAR(emission_xyz(lamp, *eye)[1], 0.2 * (0.2 + 1.8 * (555.4 - 446) / 164), 1e-12);
  const ObserverWeights lit = under_light(*eye, lamp, {500, 600});
  const Xyz seen = to_xyz(lit, {0, 1});
  EXPECT_NEAR(seen[1], 0.554, 1e-6);
  EXPECT_EQ(seen[0], 0);
}

}  // namespace
}  // namespace metamer
