// What `metamer tradeoff` says of what it found.
#include "client/cli/commands/tradeoff/tradeoff_texts.h"

#include <gtest/gtest.h>

#include "tests/client/tools/tradeoff/tradeoff_row.h"

namespace metamer::cli {
namespace {

using client::row;
using client::Tradeoff;

TEST(TradeoffTables, TellWhatFailedAndWhy) {
  Tradeoff tradeoff;
  tradeoff.plan.set_width(8);
  tradeoff.rows = {row("rgb", 0.5, 2), row("linear", 1, 0.25), row("point", 0, 0)};
  tradeoff.rows[1].error.at = 19;
  tradeoff.rows[1].front = true;
  tradeoff.rows[2].failure = "a, \"b\"";
  const Json json = tradeoff_json(tradeoff);
  EXPECT_EQ(json["rows"][1]["error"]["at"]["x"], 3);
  EXPECT_EQ(json["rows"][2]["failure"], "a, \"b\"");
  EXPECT_FALSE(json["rows"][2].contains("seconds"));
  EXPECT_EQ(
      tradeoff_table(tradeoff)[2],
      "linear                            1.0000    2.000         0      0.25       0.5  front");
}

TEST(TradeoffScript, NamesTheFrontAndKeepsHostileNamesHarmless) {
  Tradeoff tradeoff;
  tradeoff.scene = "it's\n`reboot`";
  tradeoff.rows = {row("exact", 1, 0)};
  tradeoff.rows[0].what.settings.mutable_exact();
  client::mark_front(tradeoff.rows);
  const std::string script = tradeoff_script(tradeoff);
  EXPECT_NE(script.find("set label 'exact' at 1,1e-04"), std::string::npos) << script;
  EXPECT_NE(script.find("'Cost and error of every method: it''s?`reboot`'"), std::string::npos);
}

TEST(TradeoffScript, DrawsAMethodThatHasNoLookOfItsOwn) {
  Tradeoff tradeoff;
  tradeoff.rows = {row("exact", 1, 0), row("one", 2, 0.5), row("other", 3, 0.25)};
  const std::string script = tradeoff_script(tradeoff);
  EXPECT_NE(script.find("pt 1 lc rgb '#F0E442' title 'one'"), std::string::npos) << script;
  EXPECT_NE(script.find("pt 2 lc rgb '#F0E442' title 'other'"), std::string::npos) << script;
}

}  // namespace
}  // namespace metamer::cli
