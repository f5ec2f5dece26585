// Which methods a trade compares, its front, its table of numbers, and its white.
#include "client/tools/tradeoff/tradeoff.h"

#include <gtest/gtest.h>

#include <set>

#include "client/tools/tradeoff/tradeoff_steps.h"
#include "tests/client/tools/tradeoff/tradeoff_row.h"

namespace metamer::client {
namespace {

std::string front_of(std::vector<TradeoffRow> rows) {
  mark_front(rows);
  std::string names;
  for (const TradeoffRow& one : rows)
    if (one.front) names += one.what.method;
  return names;
}

TEST(TradeoffFront, HoldsWhatNothingBeatsInBoth) {
  EXPECT_EQ(front_of({row("a", 1, 9), row("b", 2, 3), row("c", 3, 4), row("d", 4, 1)}), "abd");
  EXPECT_EQ(front_of({row("d", 4, 1), row("c", 3, 4), row("b", 2, 3), row("a", 1, 9)}), "dba");
  EXPECT_EQ(front_of({row("a", 1, 0), row("b", 2, 0)}), "a") << "no better, and dearer";
  EXPECT_EQ(front_of({row("a", 1, 2), row("b", 1, 1)}), "b") << "as cheap, and better";
  EXPECT_EQ(front_of({}), "");
}

TEST(TradeoffFront, LeavesOutWhatFailed) {
  auto failed = row("a", 0, 0);
  failed.failure = "no such method";
  EXPECT_EQ(front_of({failed, row("b", 2, 3)}), "b");
}

TEST(TradeoffCases, HaveNamesOfTheirOwn) {
  std::set<std::string> stems, settings;
  for (const TradeoffCase& one : tradeoff_cases()) {
    stems.insert(one.stem);
    settings.insert(one.settings.SerializeAsString());
  }
  EXPECT_EQ(stems.size(), 29u);
  EXPECT_EQ(settings.size(), 29u);
  EXPECT_EQ(tradeoff_cases()[0].method, "rgb");
  EXPECT_TRUE(stems.contains("linear-2-observer"));
  EXPECT_TRUE(stems.contains("point-301"));
  EXPECT_TRUE(stems.contains("point-fitted-16"));
}

TEST(TradeoffCsv, TellsWhatFailedAndWhy) {
  Tradeoff tradeoff;
  tradeoff.plan.set_width(8);
  tradeoff.rows = {row("rgb", 0.5, 2), row("linear", 1, 0.25), row("point", 0, 0)};
  tradeoff.rows[1].error.at = 19;
  tradeoff.rows[1].front = true;
  tradeoff.rows[2].failure = "a, \"b\"";
  EXPECT_EQ(tradeoff_csv(tradeoff),
            "method,parameters,prepare_seconds,render_seconds,seconds,relative_to_rgb,mean,median,"
            "percentile_95,percentile_99,maximum,x,y,not_finite,front,failure\r\n"
            "rgb,,0.125,0.375,0.5,1,0,0,2,0,4,0,0,0,0,\r\n"
            "linear,,0.25,0.75,1,2,0,0,0.25,0,0.5,3,2,0,1,\r\n"
            "point,,,,,,,,,,,,,,0,\"a, \"\"b\"\"\"\r\n");
}

TEST(TradeoffCsv, WithoutTheNaiveRgbNothingIsRelativeToIt) {
  Tradeoff tradeoff;
  tradeoff.plan.set_width(1);
  tradeoff.rows = {row("rgb", 0, 2), row("exact", 1, 0)};
  EXPECT_FALSE(rgb_seconds(tradeoff)) << "it took no time";
  const std::string text = tradeoff_csv(tradeoff);
  EXPECT_NE(text.find("exact,,0.25,0.75,1,,0,"), std::string::npos) << text;
}

TEST(TradeoffWhite, IsTheDominantLightsOfItsLuminance) {
  v1::Plan plan;
  for (const double value : {0.95, 1., 1.09}) plan.add_source_white(value);
  v1::Scene scene;
  EXPECT_FALSE(lit_white(plan, scene)) << "no light";
  scene.add_light();
  EXPECT_EQ(*lit_white(plan, scene), (Xyz{0.95, 1, 1.09}));
  scene.mutable_light(0)->set_luminance(2);
  EXPECT_EQ(*lit_white(plan, scene), (Xyz{1.9, 2, 2.18}));
  scene.mutable_light(0)->set_luminance(0);
  EXPECT_EQ(*lit_white(plan, scene), (Xyz{0.95, 1, 1.09}))
      << "a dark light has a white all the same";
  plan.set_source_white(2, 0);
  EXPECT_FALSE(lit_white(plan, scene)) << "nothing can be divided by it";
  plan.clear_source_white();
  EXPECT_FALSE(lit_white(plan, scene));
}

}  // namespace
}  // namespace metamer::client
