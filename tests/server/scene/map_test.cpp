#include "server/scene/map.h"

#include <gtest/gtest.h>

#include "tests/server/cpu/soft/sky_file.h"
#include "tests/server/scene/small_png.h"

namespace metamer {
namespace {

Result<TexturePicture> read(PictureUse use, const std::string& bytes,
                            const std::string& file = "a.png", const std::string& channel = "") {
  v1::Map map;
  map.set_file(file);
  map.set_channel(channel);
  return read_map(picture_of(map), use, "material[0].map", bytes);
}

RenderMap alpha_of(const std::string& bytes, std::optional<float> cutoff = {}) {
  v1::Map map;
  map.set_file("a.png");
  map.set_wrap(v1::Texture::CLAMP);
  auto picture = read_map(picture_of(map), PictureUse::alpha, "alpha", bytes);
  EXPECT_TRUE(picture) << picture.error().message;
  return {PlacedPicture(*std::move(picture), picture_of(map)), 1, 0, cutoff};
}

TEST(Map, TheMiddleOfEightAndOfSixteenBitsIsNoTilt) {
  const auto picture = read(PictureUse::normals, test::small_png(1, 1, 2, {'\x80', '\0', '\xFF'}));
  ASSERT_TRUE(picture) << picture.error().message;
  EXPECT_EQ(picture->weights[0], 32768);
  EXPECT_EQ(picture->weights[1], 1);
  EXPECT_EQ(picture->weights[2], 65535);
}

TEST(Map, HeightsOfAnExrHaveTheirOwnRange) {
  const auto picture =
      read(PictureUse::heights, test::sky_file(3, 1, {"Y"}, {{-2.0f}, {1.0f}, {4.0f}}), "h.exr");
  ASSERT_TRUE(picture) << picture.error().message;
  EXPECT_EQ(picture->span, 6);
  EXPECT_EQ(picture->weights[0], 0);
  EXPECT_NEAR(picture->weights[1], 32767.5, 1);
  EXPECT_EQ(picture->weights[2], 65535);
  // Of one height everywhere there is no slope.
  EXPECT_EQ(read(PictureUse::heights, test::sky_file(1, 1, {"Y"}, {{7.0f}}), "h.exr")->span, 0);
}

TEST(Map, AlphaIsTheChannelOfThatNameElseTheOnlyOne) {
  const std::string rgba = test::small_png(1, 1, 6, {'\1', '\2', '\3', '\x80'});
  EXPECT_NEAR(read(PictureUse::alpha, rgba)->weights[0], 65535 * 128 / 255.0, 1);
  EXPECT_NEAR(read(PictureUse::alpha, rgba, "a.png", "G")->weights[0], 65535 * 2 / 255.0, 1);
  EXPECT_NEAR(read(PictureUse::alpha, test::small_png(1, 1, 0, {'\x33'}))->weights[0],
              65535 * 51 / 255.0, 1);
}

TEST(Map, AShareIsTheMeanOfWhatASampleCoversAndAHardEdgeGoesByTheFinest) {
  // A quarter of four pixels.
  const std::string picture = test::small_png(2, 2, 0, {'\xFF', '\0', '\0', '\0'});
  EXPECT_NEAR(alpha_at(alpha_of(picture), 0.25f, 0.75f, 9), 0.25, 1e-4);
  EXPECT_EQ(alpha_at(alpha_of(picture), 0.25f, 0.75f, 0), 1);
  EXPECT_EQ(alpha_at(alpha_of(picture), 0.75f, 0.25f, 0), 0);
  EXPECT_EQ(alpha_at(alpha_of(picture, 0.5f), 0.25f, 0.75f, 9), 1);
  EXPECT_EQ(alpha_at(alpha_of(picture, 0.5f), 0.75f, 0.25f, 9), 0);
}

TEST(Map, WhatIsWrongIsSaidWithItsPixel) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const struct {
    Result<TexturePicture> picture;
    std::string field, message;
  } cases[] = {
      {read(PictureUse::normals, test::sky_file(1, 1, {"B", "G", "R"}, {{0.5f, 2, 0.5f}}), "n.exr"),
       ".file", "pixel 0, 0 (from the upper left): channel G is 2; it must be 0 to 1"},
      {read(PictureUse::heights, test::sky_file(2, 1, {"Y"}, {{1}, {nan}}), "h.exr"), ".file",
       "pixel 1, 0 (from the upper left): channel Y is nan; a height must be -1e6 to 1e6"},
      {read(PictureUse::alpha, test::sky_file(1, 1, {"B", "G"}, {{1, 1}}), "a.exr"), ".channel",
       "the file has 2 channels (B G), 1 is needed: name those that are meant"},
      {read(PictureUse::alpha, ""), ".file", ""}};
  for (const auto& one : cases) {
    ASSERT_FALSE(one.picture) << one.message;
    EXPECT_EQ(one.picture.error().field, "material[0].map" + one.field);
    EXPECT_TRUE(one.picture.error().message.starts_with(one.message))
        << one.picture.error().message;
  }
}

}  // namespace
}  // namespace metamer
