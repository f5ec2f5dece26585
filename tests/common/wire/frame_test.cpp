#include "common/wire/frame.h"

#include <gtest/gtest.h>

namespace metamer::wire {

namespace {

std::string header(std::uint32_t length) {
  return {static_cast<char>(length >> 24), static_cast<char>(length >> 16),
          static_cast<char>(length >> 8), static_cast<char>(length)};
}

}  // namespace

TEST(Frame, IsABigEndianLengthAndTheBytes) {
  EXPECT_EQ(encode_frame("abc"), std::string("\0\0\0\3abc", 7));
  EXPECT_EQ(encode_frame(std::string(0x010203, 'x')).substr(0, 4), std::string("\0\1\2\3", 4));
}

TEST(Frame, ComesOutAsItWentInHoweverItIsCut) {
  const std::string one = "one";
  const std::string large(300'000, 'x');
  const std::string stream = encode_frame(one) + encode_frame(large) + encode_frame(one);
  for (const std::size_t piece : {std::size_t{1}, std::size_t{3}, std::size_t{4}, std::size_t{7},
                                  std::size_t{65536}, stream.size()}) {
    FrameDecoder decoder;
    std::vector<std::string> payloads;
    for (std::size_t at = 0; at < stream.size(); at += piece) {
      decoder.feed(std::string_view(stream).substr(at, piece));
      while (auto payload = decoder.next().value()) payloads.push_back(*payload);
    }
    EXPECT_EQ(payloads, (std::vector<std::string>{one, large, one})) << "pieces of " << piece;
    EXPECT_FALSE(decoder.in_frame());
  }
}

TEST(Frame, OfTheLimitIsReadAndOfOneMoreIsAnError) {
  FrameDecoder decoder(10);
  decoder.feed(encode_frame(std::string(10, 'x')));
  EXPECT_EQ(decoder.next().value(), std::string(10, 'x'));
  decoder.feed(header(11));
  EXPECT_EQ(decoder.next().error(), FrameError::too_large);
}

TEST(Frame, Of4GiBIsAnErrorAsSoonAsItsLengthIsThere) {
  FrameDecoder decoder;
  decoder.feed(std::string("\xFF\xFF\xFF", 3));
  EXPECT_FALSE(decoder.next().value());
  decoder.feed("\xFF");
  EXPECT_EQ(decoder.next().error(), FrameError::too_large);
}

TEST(Frame, OfNothingIsAnError) {
  FrameDecoder decoder;
  decoder.feed(header(0));
  EXPECT_EQ(decoder.next().error(), FrameError::empty);
}

TEST(Frame, AfterAnErrorNothingIsReadAnyMore) {
  FrameDecoder decoder;
  decoder.feed(header(0) + encode_frame("abc"));
  EXPECT_FALSE(decoder.next());
  EXPECT_FALSE(decoder.next());
  decoder.feed(encode_frame("abc"));
  EXPECT_EQ(decoder.next().error(), FrameError::empty);
}

TEST(Frame, ATruncatedOneIsKnownAsSuch) {
  FrameDecoder decoder;
  EXPECT_FALSE(decoder.in_frame());
  decoder.feed(std::string("\0", 1));
  EXPECT_FALSE(decoder.next().value());
  EXPECT_TRUE(decoder.in_frame());
  decoder.feed(std::string("\0\0\2x", 4));
  EXPECT_FALSE(decoder.next().value());
  EXPECT_TRUE(decoder.in_frame());
  decoder.feed("y");
  EXPECT_EQ(decoder.next().value(), "xy");
  EXPECT_FALSE(decoder.in_frame());
}

TEST(Frame, SaysHowManyBytesItsNextStepNeeds) {
  FrameDecoder decoder;
  EXPECT_EQ(decoder.missing(), 4u);
  decoder.feed(std::string("\0\0", 2));
  EXPECT_EQ(decoder.missing(), 2u);
  decoder.feed(std::string("\0\5", 2));
  EXPECT_EQ(decoder.missing(), 5u);
  decoder.feed("abc");
  EXPECT_EQ(decoder.missing(), 2u);
  decoder.feed("de");
  EXPECT_EQ(decoder.missing(), 0u);
  EXPECT_EQ(decoder.next().value(), "abcde");
  EXPECT_EQ(decoder.missing(), 4u);
}

}  // namespace metamer::wire
