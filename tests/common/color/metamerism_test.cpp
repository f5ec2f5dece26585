#include "common/color/metamerism.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace metamer {
namespace {

const Mismatch& under(const std::vector<Mismatch>& all, const std::string& light) {
  return *std::find_if(all.begin(), all.end(),
                       [&](const Mismatch& one) { return one.light == light; });
}

TEST(Metamerism, OfOneReflectanceWithItselfIsNone) {
  const Spectrum& paint = *cie::test_color("TCS09");
  const auto all = metamerism(paint, paint, cie_lights(), cie::observer_1931());
  ASSERT_TRUE(all);
  EXPECT_EQ(all->size(), cie::illuminant_names().size());
  for (const Mismatch& one : *all) EXPECT_EQ(one.de00 + one.deab + one.deuv, 0) << one.light;
}

TEST(Metamerism, OfTwoGreysIsTheSameUnderEveryLight) {
  // L* of 0.5 and 0.2, CIE 15:2004, 8.2.1.
  const double expected = 116 * (std::cbrt(0.5) - std::cbrt(0.2));
  const auto all = metamerism({{500}, {0.5}}, {{500}, {0.2}}, cie_lights(), cie::observer_1964());
  ASSERT_TRUE(all);
  for (const Mismatch& one : *all) {
    EXPECT_NEAR(one.deab, expected, 1e-10) << one.light;
    EXPECT_NEAR(one.deuv, expected, 1e-10) << one.light;
  }
}

TEST(Metamerism, UnderALightThatNobodySeesIsAnError) {
  const Spectrum grey = {{500}, {0.5}};
  const auto all = metamerism(grey, grey, {{"heat", {{900, 1000}, {1, 1}}}}, cie::observer_1931());
  ASSERT_FALSE(all);
  EXPECT_EQ(all.error().message, "the light \"heat\" has no white to see");
}

/// A metamer of `paint` under D65; how far it lies under `against`.
double far_metamer(const Spectrum& paint, const char* against, Observer observer) {
  const auto made =
      make_metamer(paint, *cie::illuminant("D65"), *cie::illuminant(against), observer);
  if (!made) {
    ADD_FAILURE() << made.error().message;
    return 0;
  }
  const auto all = metamerism(paint, made->reflectance, cie_lights(), observer);
  const Mismatch& same = under(*all, "D65");
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(same.one[c], same.other[c], 1e-12);
  EXPECT_NEAR(under(*all, against).de00, made->de00, 1e-8);

  const auto& values = made->reflectance.values;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  EXPECT_GE(*least, 0);
  EXPECT_LE(*most, 1);
  return made->de00;
}

TEST(MakeMetamer, MatchesUnderOneLightAndDiffersUnderAnother) {
  for (const Observer& observer : {cie::observer_1931(), cie::observer_1964()})
    for (const std::string& name : cie::test_color_names()) {
      SCOPED_TRACE(name);
      EXPECT_GT(far_metamer(*cie::test_color(name), "F11", observer), 5);
    }
}

TEST(MakeMetamer, MatchesWhereManyBoundsMeet) {
  // It may neither fall where it is 0 nor rise where it is 1: little can be added, and nearly all
  // bounds hold at once.
  const Spectrum steps = {{400, 450, 500, 550, 600, 650, 700}, {0, 0, 1, 1, 1, 0, 1}};
  for (const char* against : {"A", "C", "F11"}) {
    SCOPED_TRACE(against);
    EXPECT_LT(far_metamer(steps, against, cie::observer_1931()), 0.1);
  }
}

TEST(MakeMetamer, AddsNothingNarrow) {
  // Steepest of cosines that reach ±1 together: a paint's flanks are no steeper than half of 47 nm.
  const Spectrum grey = {{500}, {0.5}};
  const auto made =
      make_metamer(grey, *cie::illuminant("D65"), *cie::illuminant("A"), cie::observer_1931());
  ASSERT_TRUE(made);
  // Bernstein's inequality: |f'| ≤ degree · max|f|, in radians over 470 nm for π.
  const auto& values = made->reflectance.values;
  for (std::size_t i = 1; i < values.size(); ++i)
    EXPECT_LE(std::abs(values[i] - values[i - 1]), 10 * 0.5 * 3.1416 / 470 * 1.001);
}

TEST(MakeMetamer, IsAsFarInsideASmallerBoxOrNearer) {
  // A paint of less contrast leaves more room: it has a farther metamer than a bright, nearly white
  // one.
  const auto far = [](double grey) {
    return make_metamer({{500}, {grey}}, *cie::illuminant("D65"), *cie::illuminant("F11"),
                        cie::observer_1931())
        ->de00;
  };
  EXPECT_GT(far(0.5), far(0.9));
  EXPECT_GT(far(0.9), far(0.99));
}

std::string error_of(const Spectrum& paint, const char* under, const char* against,
                     Observer observer = cie::observer_1931()) {
  const auto made =
      make_metamer(paint, *cie::illuminant(under), *cie::illuminant(against), observer);
  return made ? "" : made.error().message;
}

TEST(MakeMetamer, OfWhatHasNoneIsAnError) {
  const char* none = "no smooth reflectance in 0..1 matches it there and differs from it elsewhere";
  for (const Observer& observer : {cie::observer_1931(), cie::observer_1964()})
    for (const char* against : {"A", "C", "F4", "F11"}) {
      EXPECT_EQ(error_of({{500}, {1}}, "D65", against, observer), none) << "white, " << against;
      EXPECT_EQ(error_of({{500}, {0}}, "D65", against, observer), none) << "black, " << against;
    }
  EXPECT_EQ(error_of({{500}, {0.5}}, "D65", "D65"), none) << "one light";
  EXPECT_EQ(error_of({{400, 500}, {0.5, 1.5}}, "D65", "A"),
            "a reflectance lies in 0..1 (at 500 nm it is 1.5)");
}

TEST(MetamerismIndex, IsNoneUnderTheReferenceAndForGreys) {
  const auto greys = metamerism({{500}, {0.5}}, {{500}, {0.2}}, cie_lights(), cie::observer_1931());
  ASSERT_TRUE(greys);
  for (const Mismatch& test : *greys) {
    // Two greys part under no light: what they differ by is the same under each.
    const MetamerismIndex index = metamerism_index(greys->front(), test);
    EXPECT_NEAR(index.de00, 0, 1e-9) << test.light;
    EXPECT_NEAR(index.deab, 0, 1e-9) << test.light;
  }
}

TEST(MetamerismIndex, OfAMatchedPairIsItsDifference) {
  // By hand: white 1, one 0.25 under both; the other 0.25 under the first, 0.5, 0.25, 0.25 then.
  const Mismatch reference{.light = "a",
                           .one = {0.25, 0.25, 0.25},
                           .other = {0.25, 0.25, 0.25},
                           .white = {1, 1, 1},
                           .de00 = 0,
                           .deab = 0,
                           .deuv = 0};
  Mismatch test = reference;
  test.other = {0.5, 0.25, 0.25};
  const double da = 500 * (std::cbrt(0.5) - std::cbrt(0.25));
  EXPECT_NEAR(metamerism_index(reference, test).deab, da, 1e-9);

  // Twice as much of all under both lights: the pair does not match under the first, and is
  // corrected.
  Mismatch brighter = reference, brighter_test = test;
  for (double& value : brighter.other) value *= 2;
  for (double& value : brighter_test.other) value *= 2;
  EXPECT_NEAR(metamerism_index(brighter, brighter_test).deab, da, 1e-9);

  // What reflects nothing under the first can't be made to.
  Mismatch black = reference;
  black.other = {0, 0, 0};
  EXPECT_NEAR(metamerism_index(black, test).deab, da, 1e-9);
}

}  // namespace
}  // namespace metamer
