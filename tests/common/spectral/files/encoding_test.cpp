#include "common/spectral/files/encoding.h"

#include <gtest/gtest.h>

namespace metamer {
namespace {

std::string text_of(std::string_view bytes) {
  const auto text = utf8_text(bytes, "paint.txt");
  return text ? *text : format(text.error());
}

/// ASCII as UTF-16 in either order of bytes.
std::string utf16(std::string_view ascii, bool big) {
  std::string bytes;
  for (const char c : ascii) bytes.append(big ? std::string{'\0', c} : std::string{c, '\0'});
  return bytes;
}

TEST(Encoding, KeepsUtf8AndTakesItsMarkOff) {
  EXPECT_EQ(text_of("Grün µ 漆"), "Grün µ 漆");
  EXPECT_EQ(text_of("\xEF\xBB\xBF"
                    "a\n"),
            "a\n");
  EXPECT_EQ(text_of(""), "");
}

TEST(Encoding, ReadsUtf16InBothOrdersWithAndWithoutAMark) {
  for (const bool big : {false, true}) {
    EXPECT_EQ(text_of((big ? "\xFE\xFF" : "\xFF\xFE") + utf16("380 0.1\n", big)), "380 0.1\n");
    EXPECT_EQ(text_of(utf16("380 0.1\n", big)), "380 0.1\n");
  }
  EXPECT_EQ(text_of(std::string_view("\xFF\xFEG\0r\0\xFC\0n\0", 10)), "Grün");
  EXPECT_EQ(text_of(std::string_view("\xFF\xFE\x06\x6F", 4)), "漆");
  EXPECT_EQ(text_of(std::string_view("\xFF\xFE\x34\xD8\x1E\xDD", 6)), "𝄞")
      << "a pair of surrogates";
}

TEST(Encoding, ReadsAsLatin1WhatIsNoUtf8) {
  EXPECT_EQ(text_of("Gr\xFCn \xB5m"), "Grün µm");
  EXPECT_EQ(text_of("\xC3"), "Ã") << "half a character of UTF-8";
  EXPECT_EQ(text_of("\xC0\x80"), "À\xC2\x80") << "a character that is longer than it needs be";
  EXPECT_EQ(text_of("\xED\xA0\x80"), "í \xC2\x80") << "half a pair of surrogates";
}

TEST(Encoding, EndsLinesWithLf) {
  EXPECT_EQ(text_of("a\r\nb\rc\nd\r\r\n"), "a\nb\nc\nd\n\n");
  EXPECT_EQ(text_of(utf16("a\r\nb\r", true)), "a\nb\n");
}

TEST(Encoding, MakesBlanksOfWhatLooksLikeThem) {
  for (const char* blank : {"\xC2\xA0", "\xE2\x80\x87", "\xE2\x80\x89", "\xE2\x80\xAF"})
    EXPECT_EQ(utf8_text("400" + std::string(blank) + "0.5" + blank + "\n", "f"), "400 0.5 \n");
  EXPECT_EQ(utf8_text("400\xA0"
                      "0.5\n",
                      "f"),
            "400 0.5\n")
      << "in Latin-1";
  EXPECT_EQ(utf8_text(std::string_view("\xFF\xFE"
                                       "4\0\xA0\0"
                                       "5\0",
                                       8),
                      "f"),
            "4 5");
}

TEST(Encoding, RefusesWhatIsNoText) {
  EXPECT_EQ(text_of(std::string_view("400 1\0", 6)),
            "paint.txt: error: the file is no text: it has a NUL byte");
  EXPECT_EQ(text_of(std::string_view("\x7F"
                                     "ELF\0\0\x01\0",
                                     8)),
            "paint.txt: error: the file is no text: it has a NUL byte");
  EXPECT_EQ(text_of(std::string_view("\xFF\xFE"
                                     "a\0b",
                                     5)),
            "paint.txt: error: the file is no sound UTF-16");
  EXPECT_EQ(text_of(std::string_view("\xFF\xFE\x00\xDC"
                                     "a\0",
                                     6)),
            "paint.txt: error: the file is no sound UTF-16");
}

}  // namespace
}  // namespace metamer
