// What mends a problem in a scene's text.
#include "client/tools/scene/problem_fix.h"

#include <gtest/gtest.h>

#include "client/tools/scene/checked_scene.h"

namespace metamer::client {
namespace {

Problem problem_at(int line, int column, const char* was, const char* meant) {
  return {.field = {},
          .file = {},
          .line = line,
          .column = column,
          .message = "is wrong",
          .was = was,
          .meant = meant};
}

std::string mended(std::string text, const Problem& problem) {
  const auto edit = problem_fix(text, problem);
  if (!edit) return "nothing";
  return text.replace(edit->begin, edit->end - edit->begin, edit->text);
}

TEST(ProblemFix, PutsWhatWasMeantInThePlaceOfWhatStandsThere) {
  EXPECT_EQ(mended("a\nlihgt { }", problem_at(2, 1, "lihgt", "light")), "a\nlight { }");
  EXPECT_EQ(mended("m: \"x\" n: \"y\"", problem_at(1, 8, "y", "z")), "m: \"x\" n: \"z\"");
  EXPECT_EQ(mended("m: 'x'", problem_at(1, 1, "x", "it's")), "m: 'it\\'s'");
  EXPECT_EQ(mended("m: [1, 2.50, 3]", problem_at(1, 8, "2.50", "1")), "m: [1, 1, 3]");
  EXPECT_EQ(mended("m: -5e-1 }", problem_at(1, 1, "-5e-1", "0")), "m: 0 }");
  EXPECT_EQ(mended("m: - 5", problem_at(1, 1, "-5", "0")), "m: 0");
  EXPECT_EQ(mended("m:  # x\n \"x\"", problem_at(1, 1, "x", "y")), "m:  # x\n \"y\"");
  EXPECT_EQ(mended("ä: \"ü\" b: 1", problem_at(1, 9, "1", "2")), "ä: \"ü\" b: 2");
}

TEST(ProblemFix, ATextThatHasChangedIsLeftAlone) {
  EXPECT_EQ(mended("m: \"z\" n: \"x\" x: \"x\"", problem_at(1, 1, "y", "w")), "nothing");
  EXPECT_EQ(mended("m: 5", problem_at(1, 1, "-5", "0")), "nothing");
  EXPECT_EQ(mended("m: -5", problem_at(1, 1, "5", "0")), "nothing");
  EXPECT_EQ(mended("m: 5", problem_at(9, 9, "5", "0")), "nothing");
  EXPECT_EQ(mended("m: 5", problem_at(0, 0, "5", "0")), "nothing");
  EXPECT_EQ(mended("m: 5", problem_at(1, 1, "", "0")), "nothing");
  EXPECT_EQ(mended("m: 5", problem_at(1, 1, "5", "")), "nothing");
  EXPECT_EQ(mended("", problem_at(1, 1, "5", "0")), "nothing");
}

constexpr const char* sound_scene = R"(camera { eye { z: 4 } target {} }
light { name: "lamp" position { z: 4 } spectrum { standard: "D65" } luminance: 1 }
material { name: "tcs09" diffuse { constant: 0.5 } mirror: 0 }
object { name: "ball" material: "tcs09" sphere { radius: 1 } }
settings { width: 64 height: 64 tile_size: 16 shading: PHONG }
)";

/// Each wrong in one place, by what stands there and what stands there then.
constexpr const char* wrongs[][2] = {
    {"material: \"tcs09\"", "material: \"tsc09\""},
    {"sphere {", "spehre {"},
    {"camera {", "cameera {"},
    {"PHONG", "PONG"},
    {"\"D65\"", "\"D66\""},
    {"\"D65\"", "\"2856\""},
    {"constant: 0.5", "constant: 1.50"},
    {"constant: 0.5", "constant: -0.5"},
    {"mirror: 0", "mirror: 3"},
    {"luminance: 1", "luminance: -1"},
    {"width: 64", "width: 4000000000"},
    {"tile_size: 16", "tile_size: 17"},
    {"tile_size: 16", "tile_size:\n  # eight or more\n  3"},
};

TEST(ProblemFix, EveryProblemThatOffersSomethingIsMendedByIt) {
  DigestCache digests;
  for (const auto& [right, wrong] : wrongs) {
    std::string text = sound_scene;
    text.replace(text.find(right), std::string(right).size(), wrong);
    const CheckedScene broken = CheckedScene::parse(text, "scene.txtpb", digests);
    ASSERT_EQ(broken.problems().size(), 1u) << wrong;
    ASSERT_FALSE(broken.problems()[0].meant.empty()) << wrong;
    const std::string after = mended(text, broken.problems()[0]);
    EXPECT_TRUE(CheckedScene::parse(after, "scene.txtpb", digests).sound()) << after;
  }
}

TEST(ProblemFix, AMissingFileIsReplacedByAnother) {
  DigestCache digests;
  std::string text = sound_scene;
  text.replace(text.find("constant: 0.5"), 13, "file: \"gone.csv\"");
  const CheckedScene broken = CheckedScene::parse(text, "scene.txtpb", digests);
  ASSERT_EQ(broken.problems().size(), 1u);
  EXPECT_EQ(broken.problems()[0].was, "gone.csv");
  const auto edit = replacement(text, broken.problems()[0], "spectra/red.csv");
  ASSERT_TRUE(edit.has_value());
  EXPECT_EQ(text.substr(edit->begin, edit->end - edit->begin), "\"gone.csv\"");
  EXPECT_EQ(edit->text, "\"spectra/red.csv\"");
}

}  // namespace
}  // namespace metamer::client
