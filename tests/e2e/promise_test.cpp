// What a scene needs, what each method would cost and miss, and what a chosen one promises.
#include <gtest/gtest.h>

#include <filesystem>

#include "daemon.h"
#include "scenes.h"

namespace metamer::test {
namespace {

class Promised : public testing::Test {
 protected:
  Daemon daemon;
  Folder folder;
  std::string scene = folder.write("scene.txtpb", small_scene());
};

TEST_F(Promised, ExplainSaysWhatASceneNeedsAndPredictsEveryMethod) {
  const Json answer = daemon.json({"explain", scene});
  ASSERT_EQ(answer["exit_code"], 0) << answer;
  EXPECT_GT(answer["plan"]["need"].size(), 3u);
  EXPECT_GT(answer["plan"]["unneeded"].size(), 0u);
  const Json& predictions = answer["plan"]["prediction"];
  ASSERT_GT(predictions.size(), 8u);
  double rgb = -1, exact = -1;
  int chosen = 0;
  for (const Json& one : predictions) {
    EXPECT_GT(one["render"].get<double>(), 0);
    chosen += one["chosen"].get<bool>();
    if (one["method"].contains("rgb")) rgb = one["error"]["maximum"];
    if (one["method"].contains("exact")) exact = one["error"]["maximum"];
  }
  EXPECT_EQ(chosen, 1);
  EXPECT_GT(rgb, 0.5);
  EXPECT_GE(exact, 0);
  EXPECT_LT(exact, 0.02);

  const Ended text = daemon.metamer({"explain", scene, "--method", "exact"});
  EXPECT_EQ(text.code, 0);
  EXPECT_NE(text.out.find("* exact"), std::string::npos) << text.out;
}

TEST_F(Promised, AnExplainedJobHasNoPictureToFetch) {
  ASSERT_EQ(daemon.metamer({"explain", scene}).code, 0);
  const Ended ended = daemon.metamer({"fetch", "1", "-o", folder / "a.png"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("checked or explained only"), std::string::npos) << ended.err;
}

TEST_F(Promised, AToleranceIsKeptAndMeasuredOnFreshPixels) {
  for (const std::string tolerance : {"0.1", "2"}) {
    const Json answer =
        daemon.json({"render", scene, "--tolerance", tolerance, "-o", folder / "a.png"});
    ASSERT_EQ(answer["exit_code"], 0) << answer;
    EXPECT_TRUE(answer["accuracy"]["kept"].get<bool>());
    EXPECT_LE(answer["accuracy"]["error"]["maximum"].get<double>(), std::stod(tolerance));
    EXPECT_GT(answer["accuracy"]["error"]["pixels"].get<int>(), 16);
    EXPECT_FALSE(answer["plan"]["method"].contains("auto"));
    EXPECT_EQ(answer["plan"]["auto"]["tolerance"], std::stod(tolerance));
  }
}

TEST_F(Promised, IsAskedForInTheSceneByEitherName) {
  for (const std::string goal : {"goal { tolerance: 2 }", "method { auto { tolerance: 2 } }"}) {
    std::string text = small_scene();
    text.insert(text.find("settings {") + 10, " " + goal);
    const Json answer =
        daemon.json({"render", folder.write("goal.txtpb", text), "-o", folder / "a.png"});
    ASSERT_EQ(answer["exit_code"], 0) << answer;
    EXPECT_EQ(answer["plan"]["auto"]["tolerance"], 2) << goal;
    EXPECT_TRUE(answer["accuracy"]["kept"].get<bool>()) << goal;
  }
}

TEST_F(Promised, ABrokenOneHasItsExitCodeAndThePictureIsThereAllTheSame) {
  const std::string file = folder / "late.png";
  const Ended ended = daemon.metamer({"render", scene, "--deadline", "0.000001s", "-o", file});
  EXPECT_EQ(ended.code, 6) << ended.err;
  EXPECT_NE(ended.err.find("no method keeps to a deadline of 1e-06 s"), std::string::npos)
      << ended.err;
  EXPECT_NE(ended.err.find("the promise is broken by"), std::string::npos) << ended.err;
  EXPECT_TRUE(std::filesystem::exists(file));
}

TEST_F(Promised, SaysHowManyOfAllPixelsAreKnownToKeepIt) {
  const Json answer = daemon.json({"render", scene, "--tolerance", "1", "-o", folder / "a.png"});
  const Json& accuracy = answer["accuracy"];
  EXPECT_GT(accuracy["error"]["share"].get<double>(), 0.9);
  EXPECT_LT(accuracy["error"]["share"].get<double>(), 1);
  EXPECT_EQ(accuracy["white"].size(), 3u);
  EXPECT_EQ(accuracy["observer"], "cie-1931-2deg");
}

TEST_F(Promised, AVerifiedPictureIsKnownPixelByPixelWithAGoalAndWithout) {
  const Json plain =
      daemon.json({"render", scene, "--verify", "--exr", "xyz", "-o", folder / "a.exr"});
  ASSERT_EQ(plain["exit_code"], 0) << plain;
  EXPECT_GT(plain["plan"]["verify_cost"].get<double>(), 0);
  const Json& error = plain["accuracy"]["error"];
  EXPECT_EQ(error["share"], 1);
  EXPECT_EQ(error["pixels"].get<int>(),
            plain["plan"]["width"].get<int>() * plain["plan"]["height"].get<int>());
  EXPECT_LT(error["maximum"].get<double>(), 0.02);
  EXPECT_GT(plain["timing"]["verify"].get<double>(), 0);
  EXPECT_TRUE(plain["accuracy"]["kept"].get<bool>());

  // The naive way is off, and nothing was promised.
  const Json naive = daemon.json(
      {"render", scene, "--verify", "--method", "rgb", "--exr", "xyz", "-o", folder / "b.exr"});
  EXPECT_EQ(naive["exit_code"], 0);
  EXPECT_GT(naive["accuracy"]["error"]["maximum"].get<double>(), 0.5);
  std::string white;
  for (const Json& value : naive["accuracy"]["white"])
    white += (white.empty() ? "" : ",") + std::to_string(value.get<double>());
  const Ended compared =
      metamer({"compare", folder / "b.exr", folder / "a.exr", "--white", white, "--json"});
  const Json difference = parse_document(compared.out)["difference"];
  for (const char* statistic : {"mean", "percentile_95", "maximum"})
    EXPECT_NEAR(naive["accuracy"]["error"][statistic].get<double>(),
                difference[statistic].get<double>(), 0.01)
        << statistic;

  const Ended broken =
      daemon.metamer({"render", scene, "--verify", "--tolerance", "1e-9", "-o", folder / "c.exr"});
  EXPECT_EQ(broken.code, 6) << broken.err;
  EXPECT_NE(broken.err.find("verified, at about"), std::string::npos) << broken.err;
  EXPECT_NE(broken.err.find("the promise is broken by exact: ΔE00 against the reference, on all"),
            std::string::npos)
      << broken.err;
}

TEST_F(Promised, WordsThatMakeNoSenseAreRefused) {
  const auto refused = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"render", scene, "-o", folder / "a.png"});
    const Ended ended = daemon.metamer(words);
    EXPECT_EQ(ended.code, 2);
    return ended.err;
  };
  EXPECT_NE(refused({"--tolerance", "1", "--deadline", "1"}).find("exclude each other"),
            std::string::npos);
  EXPECT_NE(refused({"--tolerance", "1", "--method", "rgb"}).find("is for --method auto"),
            std::string::npos);
  EXPECT_NE(refused({"--deadline", "soon"}).find("is not a time"), std::string::npos);
  EXPECT_NE(refused({"--tolerance", "0"}).find("tolerance must be above 0"), std::string::npos);
  EXPECT_NE(refused({"--tolerance", "nan"}).find("tolerance"), std::string::npos);
}

}  // namespace
}  // namespace metamer::test
