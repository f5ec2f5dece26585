// A metamer and the table of how it differs.
#include "client/tools/spectra/metamer_table.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace metamer::client {
namespace {

NamedSpectrum light_named(const std::string& name) {
  return {.name = name, .spectrum = *cie::illuminant(name)};
}

const Mismatch& under(const MetamerTable& table, const std::string& light) {
  const auto found = std::find_if(table.differences.begin(), table.differences.end(),
                                  [&](const Mismatch& one) { return one.light == light; });
  EXPECT_NE(found, table.differences.end()) << light;
  return *found;
}

TEST(MetamerTable, MatchesUnderOneLightAndDiffersUnderTheOther) {
  const auto table = metamer_table(*cie::test_color("TCS05"), light_named("D65"),
                                   light_named("F11"), cie::observer_1931());
  ASSERT_TRUE(table);
  for (const double value : table->reflectance.values) {
    EXPECT_GE(value, 0);
    EXPECT_LE(value, 1);
  }
  const Mismatch& same = under(*table, "D65");
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(same.one[c], same.other[c], 1e-12);
  EXPECT_LT(same.de00, 1e-6);
  EXPECT_GT(under(*table, "F11").de00, 5);
  EXPECT_EQ(table->differences.size(), cie::illuminant_names().size()) << "each light once";
}

TEST(MetamerTable, HasTheLightsThatNobodyElseNames) {
  const NamedSpectrum lamp{.name = "lamp.txt", .spectrum = {{380, 560, 780}, {1, 3, 2}}};
  const auto table =
      metamer_table(*cie::test_color("TCS03"), lamp, light_named("A"), cie::observer_1964());
  ASSERT_TRUE(table);
  EXPECT_EQ(table->differences.size(), cie::illuminant_names().size() + 1);
  EXPECT_LT(under(*table, "lamp.txt").deab, 1e-6);
}

TEST(MetamerTable, RefusesWhatHasNoMetamer) {
  for (const double reflectance : {0., 1.})
    EXPECT_FALSE(metamer_table({{500}, {reflectance}}, light_named("D65"), light_named("A"),
                               cie::observer_1931()));
  EXPECT_FALSE(
      metamer_table({{500}, {0.5}}, light_named("D65"), light_named("D65"), cie::observer_1931()))
      << "two lights of one shape";
  const NamedSpectrum red{.name = "red.txt", .spectrum = {{700}, {1}}};
  EXPECT_FALSE(
      metamer_table(*cie::test_color("TCS03"), light_named("D65"), red, cie::observer_1931()))
      << "a white without Z";
}

TEST(MetamerTable, DaylightIsTriedUnderA) {
  EXPECT_EQ(usual_other_light("D65"), "A");
  EXPECT_EQ(usual_other_light("A"), "D65");
  EXPECT_EQ(usual_other_light("lamp.txt"), "A");
}

}  // namespace
}  // namespace metamer::client
