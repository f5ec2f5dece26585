// The styles of a scene's text, byte by byte: p plain, f field, t text, o open text, n number,
// c comment, w word, b brace.
#include "client/gui/editor/scene_styles.h"

#include <gtest/gtest.h>

namespace metamer::gui {
namespace {

std::string letters(std::string_view text) {
  std::string result = scene_styles(text);
  for (char& c : result) c = "pftoncwb"[static_cast<int>(c)];
  return result;
}

TEST(SceneStyles, TellFieldsFromValues) {
  EXPECT_EQ(letters("a { b: C }"),  //
            "fpbpfppwpb");
  EXPECT_EQ(letters("a: [B, C] d: -1.5e-3f e"),  //
            "fppbwppwbpfppnnnnnnnnpf");
  EXPECT_EQ(letters("a: 'x' b: \"y\""),  //
            "fpptttpfppttt");
  EXPECT_EQ(letters("a: -inf"), "fppnwww");
}

TEST(SceneStyles, ALineDoesNotDependOnOthers) {
  EXPECT_EQ(letters("a: \"x\nb: 1"),  //
            "fppoopfppn");
  EXPECT_EQ(letters("a: # b {\nc"),  //
            "fppcccccpf");
  EXPECT_EQ(letters("\"a\\\""), "oooo");
  EXPECT_EQ(letters("\"a\\"), "ooo");
}

TEST(SceneStyles, QuotesAndCommentsHideBraces) {
  const std::string line = "a { b: \"}\" # }";
  EXPECT_EQ(depth_after(line, scene_styles(line), 0), 1);
  EXPECT_EQ(depth_after("}}", scene_styles("}}"), 1), 0);
  EXPECT_EQ(depth_after("[<", scene_styles("[<"), 1), 3);
}

TEST(SceneStyles, EveryByteHasOne) {
  std::string all;
  for (int round = 0; round < 3; ++round)
    for (int c = 0; c < 256; ++c) all += static_cast<char>(c * (2 * round + 1));
  const std::string styles = scene_styles(all);
  ASSERT_EQ(styles.size(), all.size());
  for (const char c : styles) EXPECT_LT(static_cast<int>(c), scene_style_count);
  EXPECT_EQ(scene_styles(""), "");
}

}  // namespace
}  // namespace metamer::gui
