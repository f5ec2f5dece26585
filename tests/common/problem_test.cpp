#include "common/problem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace metamer {
namespace {

Problem at(int line, int column) {
  return {.field = "light[0].luminance",
          .file = "booth.txtpb",
          .line = line,
          .column = column,
          .message = "luminance must be above 0"};
}

TEST(ProblemFormat, ShowsTheLineWithACaretUnderTheColumn) {
  EXPECT_EQ(format(at(2, 11), "camera {}\nlight { luminance: -1 }\nmaterial {}\n"),
            "booth.txtpb:2:11: error: luminance must be above 0\n"
            "light { luminance: -1 }\n"
            "          ^");
}

TEST(ProblemFormat, KeepsTabsSoThatTheCaretStaysAligned) {
  EXPECT_EQ(format(at(1, 4), "\ta\tb c"),
            "booth.txtpb:1:4: error: luminance must be above 0\n"
            "\ta\tb c\n"
            "\t \t^");
}

TEST(ProblemFormat, CountsACharacterOfSeveralBytesAsOneBlank) {
  EXPECT_EQ(format(at(1, 6), "\"é\" x"),  // é is two bytes, so x is byte 6.
            "booth.txtpb:1:6: error: luminance must be above 0\n"
            "\"é\" x\n"
            "    ^");
}

TEST(ProblemFormat, SaysLessWhereLessIsKnown) {
  EXPECT_EQ(format(at(2, 0), "a\nb\n"), "booth.txtpb:2: error: luminance must be above 0\nb");
  EXPECT_EQ(format(at(2, 3)), "booth.txtpb:2:3: error: luminance must be above 0");
  EXPECT_EQ(format(at(9, 3), "a\nb\n"), "booth.txtpb:9:3: error: luminance must be above 0");
  EXPECT_EQ(format(at(0, 0), "a\nb\n"),
            "booth.txtpb: error: light[0].luminance: luminance must be above 0");
  EXPECT_EQ(format({.field = "light[0].name", .file = {}, .message = "it is empty"}),
            "error: light[0].name: it is empty");
  EXPECT_EQ(format({.field = {}, .file = {}, .message = "it is empty"}), "error: it is empty");
}

TEST(ProblemFormat, DropsTheCarriageReturnOfAWindowsLine) {
  EXPECT_EQ(format(at(1, 1), "ab\r\ncd\r\n"),
            "booth.txtpb:1:1: error: luminance must be above 0\nab\n^");
}

TEST(ProblemFormat, PutsTheCaretBehindTheLineWhenSomethingIsMissingThere) {
  EXPECT_EQ(format(at(1, 3), "ab\ncd"),
            "booth.txtpb:1:3: error: luminance must be above 0\nab\n  ^");
  EXPECT_EQ(format(at(1, 99), "ab\ncd"),
            "booth.txtpb:1:99: error: luminance must be above 0\nab\n  ^");
}

TEST(ProblemFormat, CutsALongLineAroundTheCaret) {
  // The column of the X; 66 bytes stay before it, 34 from it on.
  const std::string line = std::string(500, '-') + "X" + std::string(500, '-');
  EXPECT_EQ(format(at(1, 501), line), "booth.txtpb:1:501: error: luminance must be above 0\n…" +
                                          std::string(66, '-') + "X" + std::string(33, '-') +
                                          "…\n" + std::string(67, ' ') + "^");
  // Near the beginning only the end is cut.
  EXPECT_EQ(format(at(1, 2), line), "booth.txtpb:1:2: error: luminance must be above 0\n" +
                                        std::string(100, '-') + "…\n ^");
}

TEST(ProblemFormat, NeverCutsThroughACharacter) {
  std::string line;
  for (int i = 0; i < 300; ++i) line += "é";
  for (int column = 1; column < 600; column += 2) {
    const std::string text = format(at(1, column), line);
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
      ASSERT_EQ(text[i] == '\xC3', text[i + 1] == '\xA9') << column;
    }
  }
}

TEST(ProblemFormat, LetsNoControlCharacterReachATerminal) {
  EXPECT_EQ(format({.field = {}, .file = "a\x1B]0;x", .line = 1, .column = 1, .message = "b\x07\n"},
                   "\x1B[2J\x7F"),
            "a?]0;x:1:1: error: b??\n?[2J?\n^");
}

TEST(DidYouMean, FindsANameWithATypingMistake) {
  const std::vector<std::string> known = {"TCS08", "TCS09", "D65", "wall"};
  EXPECT_EQ(did_you_mean("tcs09", known), "; did you mean \"TCS09\"?");
  EXPECT_EQ(did_you_mean("TSC08", known), "; did you mean \"TCS08\"?") << "two swapped";
  EXPECT_EQ(did_you_mean("walll", known), "; did you mean \"wall\"?") << "one too many";
  EXPECT_EQ(did_you_mean("D6", known), "; did you mean \"D65\"?") << "one missing";
  EXPECT_EQ(did_you_mean("D56", known), "; did you mean \"D65\"?") << "a short name may have one";
}

TEST(UnknownName, NamesWhatCanTakeItsPlaceOrNothing) {
  const Problem near = unknown_name("no lamp named \"keey\"", "keey", {"fill", "key"});
  EXPECT_EQ(near.message, "no lamp named \"keey\"; did you mean \"key\"?");
  EXPECT_EQ(near.was, "keey");
  EXPECT_EQ(near.meant, "key");
  const Problem far = unknown_name("no lamp named \"sun\"", "sun", {"fill", "key"});
  EXPECT_EQ(far.message, "no lamp named \"sun\"");
  EXPECT_EQ(far.was + far.meant, "");
}

TEST(DidYouMean, IsSilentWhereNothingIsClose) {
  EXPECT_EQ(did_you_mean("ceiling", {"wall", "floor"}), "");
  EXPECT_EQ(did_you_mean("abcdef", {"abcxyz"}), "") << "three of six are more than a third";
  EXPECT_EQ(did_you_mean("abcdef", {"abcdxy"}), "; did you mean \"abcdxy\"?");
  EXPECT_EQ(did_you_mean("", {"a"}), "");
  EXPECT_EQ(did_you_mean("a", {}), "");
  EXPECT_EQ(did_you_mean(std::string(100'000, 'a'), {std::string(100'000, 'a')}), "");
}

TEST(DidYouMean, PrefersTheClosestAndOfEqualsTheFirst) {
  EXPECT_EQ(did_you_mean("sphere2", {"sphere33", "sphere1", "sphere3"}),
            "; did you mean \"sphere1\"?");
  EXPECT_EQ(did_you_mean("metal", {"mettle", "meta"}), "; did you mean \"meta\"?");
}

TEST(Quoted, IsShortAndPrintable) {
  EXPECT_EQ(quoted("a\tb"), "\"a?b\"");
  EXPECT_EQ(quoted(std::string(60, 'x')), "\"" + std::string(60, 'x') + "\"");
  EXPECT_EQ(quoted(std::string(61, 'x')), "\"" + std::string(60, 'x') + "…\"");
  EXPECT_EQ(quoted(std::string(59, 'x') + "éé"), "\"" + std::string(59, 'x') + "…\"");
}

TEST(NumberText, IsTheShortestThatReadsBack) {
  EXPECT_EQ(number_text(400), "400");
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(1e300), "1e+300");
  EXPECT_EQ(number_text(-1.0 / 3), "-0.3333333333333333");
  EXPECT_EQ(number_text(std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(number_text(-std::numeric_limits<double>::infinity()), "-inf");
}

}  // namespace
}  // namespace metamer
