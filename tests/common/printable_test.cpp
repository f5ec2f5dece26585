#include "common/printable.h"

#include <gtest/gtest.h>

namespace metamer {

TEST(Printable, LeavesTextsOfAllLanguagesAlone) {
  for (const char* text : {"", "a b", "Größe µm × 2", "日本語", "עברית", "\xF0\x9F\x8E\xA8"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, TakesFromATerminalWhatCommandsIt) {
  EXPECT_EQ(printable("a\x1b[2Jb"), "a?[2Jb");
  EXPECT_EQ(printable("a\nb\tc\r\x7F"), "a?b?c??");
  EXPECT_EQ(printable(std::string_view("\0", 1)), "?");
  EXPECT_EQ(printable("\xC2\x9B"
                      "2J"),
            "?2J");                                         // CSI as one character
  EXPECT_EQ(printable("\xE2\x80\xAEgpj.exe"), "?gpj.exe");  // right to left
  EXPECT_EQ(printable("a\xE2\x80\xA8"
                      "b\xE2\x81\xA6"),
            "a?b?");
}

TEST(Printable, TakesWhatIsNoUtf8) {
  EXPECT_EQ(printable("\x9B"
                      "2J"),
            "?2J");                                  // CSI as one byte
  EXPECT_EQ(printable("\xC0\x9B"), "??");            // an overlong ESC
  EXPECT_EQ(printable("\xED\xA0\x80"), "???");       // a surrogate
  EXPECT_EQ(printable("\xF5\x80\x80\x80"), "????");  // beyond Unicode
  EXPECT_EQ(printable("gr\xC3"), "gr?");             // cut
}

TEST(Printable, KeepsTheLinesOfATextThatHasSome) {
  EXPECT_EQ(printable("a\nb\tc\r", "\n\t"), "a\nb\tc?");
}

}  // namespace metamer
