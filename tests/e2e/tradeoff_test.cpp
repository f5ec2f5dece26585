// `metamer tradeoff`: every method on one small scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "daemon.h"
#include "scenes.h"

namespace metamer::test {
namespace {

TEST(TradeoffCommand, RanksEveryMethodOnAScene) {
  const Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene()), out = folder / "out/new";
  const Ended ended = metamer(
      {"tradeoff", scene, "-o", out, "--rounds", "1", "--size", "16x12", "--spp", "1", "--json"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  const Json answer = parse_document(ended.out);
  ASSERT_EQ(answer["rows"].size(), 29u);
  EXPECT_TRUE(answer["reference"]["plan"]["method"].contains("exact"));
  for (const char* name : {"tradeoff.csv", "tradeoff.json", "tradeoff.png", "diff-rgb.png"})
    EXPECT_TRUE(std::filesystem::exists(out + "/" + name)) << name;

  // Along the front the error falls as the price rises.
  std::vector<std::pair<double, double>> front;
  for (const Json& row : answer["rows"]) {
    if (row.contains("failure")) {
      EXPECT_NE(row["failure"], "");
      continue;
    }
    EXPECT_TRUE(std::filesystem::exists(out + "/" + row["difference"].get<std::string>())) << row;
    EXPECT_EQ(row["error"]["not_finite"], 0) << row;
    if (row["front"])
      front.emplace_back(row["seconds"].get<double>(), row["error"]["percentile_95"].get<double>());
    // The reference is exact, and many wavelengths are near it.
    if (row["method"] == "exact") {
      EXPECT_EQ(row["error"]["maximum"].get<double>(), 0);
    }
    if (row["parameters"] == "301 uniform") {
      EXPECT_LT(row["error"]["maximum"].get<double>(), 0.5);
    }
    // And a colour by three numbers is far off under A.
    if (row["method"] == "rgb") {
      EXPECT_GT(row["error"]["maximum"].get<double>(), 1);
    }
  }
  std::sort(front.begin(), front.end());
  ASSERT_FALSE(front.empty());
  for (std::size_t i = 1; i < front.size(); ++i) EXPECT_LT(front[i].second, front[i - 1].second);
}

TEST(TradeoffCommand, ChoosesTheMethodsItself) {
  const Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene());
  const Ended ended = metamer({"tradeoff", scene, "-o", folder / "out", "--method", "rgb"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.err,
            "error: tradeoff runs every method: options that choose one are not for it\n");
}

}  // namespace
}  // namespace metamer::test
