#include "server/scene/texture.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

#include "tests/server/cpu/soft/sky_file.h"
#include "tests/server/scene/small_png.h"

namespace metamer {
namespace {

v1::Texture texture(const std::string& file, int spectra, v1::Texture::Use use = v1::Texture::BLEND,
                    const std::vector<std::string>& channels = {}) {
  v1::Texture message;
  message.set_file(file);
  message.set_use(use);
  for (int i = 0; i < spectra; ++i) message.add_spectrum()->set_constant(0.5);
  for (const std::string& channel : channels) message.add_channel(channel);
  return message;
}

Result<TexturePicture> read(const v1::Texture& message, const std::string& bytes) {
  return read_texture(message, "material[0].texture", bytes);
}

std::vector<float> weights_at(const TexturePicture& picture, float u, float v, float level = 0,
                              v1::Texture::Wrap wrap = v1::Texture::REPEAT) {
  std::vector<float> sum(picture.channels);
  add_weights(picture, wrap, u, v, level, sum.data());
  return sum;
}

TEST(Texture, ABlendsWeightsAreTheNumbersAsTheyAreStored) {
  const auto picture = read(texture("a.png", 3), test::small_png(2, 1, 2,
                                                                 {'\x00', '\x33', '\x66',  //
                                                                  '\x80', '\x01', '\x20'}));
  ASSERT_TRUE(picture) << picture.error().message;
  ASSERT_EQ(picture->channels, 3u);
  const std::vector<float> left = weights_at(*picture, 0.25f, 0.5f),
                           right = weights_at(*picture, 0.75f, 0.5f);
  const double expected[] = {0, 51 / 255.0, 102 / 255.0, 128 / 255.0, 1 / 255.0, 32 / 255.0};
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(left[c], expected[c], 1e-5);
    EXPECT_NEAR(right[c], expected[3 + c], 1e-5);
  }
}

TEST(Texture, ChannelsAreTakenByTheirNames) {
  const auto picture = read(texture("a.png", 2, v1::Texture::BLEND, {"B", "R"}),
                            test::small_png(1, 1, 2, {'\x10', '\xFF', '\x20'}));
  ASSERT_TRUE(picture) << picture.error().message;
  const std::vector<float> weights = weights_at(*picture, 0.5f, 0.5f);
  EXPECT_NEAR(weights[0], 32 / 255.0, 1e-5);
  EXPECT_NEAR(weights[1], 16 / 255.0, 1e-5);
}

TEST(Texture, AnIndexGoesByNumbersAndNotByThePalettesColours) {
  for (const int color_type : {0, 3}) {
    const auto picture = read(texture("a.png", 2, v1::Texture::INDEX),
                              test::small_png(3, 1, color_type, {'\0', '\1', '\2'}));
    ASSERT_TRUE(picture) << picture.error().message;
    const float expected[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    for (std::size_t pixel = 0; pixel < 3; ++pixel) {
      const float u = (static_cast<float>(pixel) + 0.5f) / 3;
      for (std::size_t c = 0; c < 2; ++c)
        EXPECT_NEAR(weights_at(*picture, u, 0.5f)[c], expected[pixel][c], 1e-6);
    }
  }
}

TEST(Texture, WhatIsWrongIsSaidWithItsPixel) {
  const struct {
    v1::Texture texture;
    std::string bytes, field, message;
  } cases[] = {
      {texture("a.png", 3), test::small_png(1, 2, 2, {'\1', '\1', '\1', '\x60', '\x60', '\x60'}),
       ".file", "pixel 0, 1 (from the upper left): the weights sum to 1.129"},
      {texture("a.png", 1, v1::Texture::INDEX), test::small_png(2, 1, 0, {'\1', '\2'}), ".file",
       "pixel 1, 0 (from the upper left): it is 2, the number of no spectrum: there is 1"},
      {texture("a.png", 2), test::small_png(1, 1, 2, {'\1', '\1', '\1'}), ".channel",
       "the file has 3 channels (R G B), 2 are needed: name those that are meant"},
      {texture("a.png", 1, v1::Texture::BLEND, {"Z"}), test::small_png(1, 1, 0, {'\1'}),
       ".channel[0]", "the file has no channel \"Z\""},
      {texture("a.png", 1), "no picture", ".file", "can't read the picture: Not a PNG file"},
      {texture("a.exr", 1), "no picture", ".file", ""},
      {texture("a.png", 1), "", ".file", ""},
  };
  for (const auto& one : cases) {
    const auto picture = read(one.texture, one.bytes);
    ASSERT_FALSE(picture) << one.message;
    EXPECT_EQ(picture.error().field, "material[0].texture" + one.field);
    EXPECT_EQ(picture.error().file, one.texture.file());
    EXPECT_TRUE(picture.error().message.starts_with(one.message)) << picture.error().message;
  }
}

TEST(Texture, ChannelsOfAnExrAreThereAndNamedOnce) {
  const std::string file = test::sky_file(1, 1, {"cyan", "magenta"}, {{0.25f, 0.5f}});
  const auto found = read(texture("a.exr", 2, v1::Texture::BLEND, {"magenta", "cyan"}), file);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_NEAR(weights_at(*found, 0, 0)[0], 0.5, 1e-5);
  const auto wrong = [&](const std::vector<std::string>& channels) {
    const auto picture = read(
        texture("a.exr", static_cast<int>(channels.size()), v1::Texture::BLEND, channels), file);
    return picture ? "" : picture.error().message;
  };
  EXPECT_EQ(wrong({"cyan", "magneta"}),
            "the file has no channel \"magneta\"; did you mean \"magenta\"?");
  EXPECT_EQ(wrong({"cyan", "cyan"}), "channel \"cyan\" is named twice");
}

TEST(Texture, SumsThatEightBitsRoundAboveOneAreScaledBack) {
  // 86 + 86 + 84 = 256 of 255.
  const auto picture =
      read(texture("a.png", 3), test::small_png(1, 1, 2, {'\x56', '\x56', '\x54'}));
  ASSERT_TRUE(picture) << picture.error().message;
  const std::vector<float> weights = weights_at(*picture, 0, 0);
  EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 1, 4e-5);
  EXPECT_NEAR(weights[0] / weights[2], 86.0 / 84, 1e-3);
}

/// Smaller copies of any size keep the mean: nothing is left out at odd sizes.
TEST(Texture, EveryLevelHasTheMeanOfTheFirst) {
  for (const auto& [width, height] :
       {std::pair(5u, 3u), {1u, 7u}, {16u, 16u}, {1u, 1u}, {13u, 1u}}) {
    std::vector<std::uint16_t> weights;
    for (std::uint32_t i = 0; i < width * height; ++i)
      weights.push_back(static_cast<std::uint16_t>(i * 7919 % 60000));
    const double mean = std::accumulate(weights.begin(), weights.end(), 0.0) / (width * height);
    const TexturePicture picture = with_levels(width, height, 1, weights);
    for (const auto& level : picture.levels) {
      double sum = 0;
      for (std::size_t i = 0; i < level.width * level.height; ++i)
        sum += picture.weights[level.first + i];
      EXPECT_NEAR(sum / (level.width * level.height), mean, 1.5) << width << " × " << height;
    }
    EXPECT_EQ(picture.levels.back().width * picture.levels.back().height, 1u);
  }
}

TEST(Texture, WrapsAsItIsTold) {
  // 0 1 2 3 of 4, from the left.
  const TexturePicture picture = with_levels(4, 1, 1, {0, 10000, 20000, 30000});
  const auto at = [&](float u, v1::Texture::Wrap wrap) {
    return std::lround(weights_at(picture, u, 0.5f, 0, wrap)[0] * 65535 / 10000);
  };
  const float u[] = {-0.125f, 0.125f, 0.875f, 1.125f, 2.125f, -1.125f};
  const long repeat[] = {3, 0, 3, 0, 0, 3}, clamp[] = {0, 0, 3, 3, 3, 0},
             mirror[] = {0, 0, 3, 3, 0, 3};
  for (std::size_t i = 0; i < std::size(u); ++i) {
    EXPECT_EQ(at(u[i], v1::Texture::REPEAT), repeat[i]) << u[i];
    EXPECT_EQ(at(u[i], v1::Texture::CLAMP), clamp[i]) << u[i];
    EXPECT_EQ(at(u[i], v1::Texture::MIRROR), mirror[i]) << u[i];
  }
}

TEST(Texture, OfOneWeightIsThatWeightAtEveryPlaceAndLevel) {
  const TexturePicture picture = with_levels(6, 5, 1, std::vector<std::uint16_t>(30, 32768));
  constexpr float infinity = std::numeric_limits<float>::infinity(),
                  nan = std::numeric_limits<float>::quiet_NaN();
  for (const float place : {0.0f, 0.3f, 1.0f, -7.7f, 1e9f, -1e30f, infinity, -infinity, nan})
    for (const float level : {-100.0f, 0.0f, 0.5f, 1.7f, 99.0f, infinity, -infinity, nan})
      for (const auto wrap : {v1::Texture::REPEAT, v1::Texture::CLAMP, v1::Texture::MIRROR})
        EXPECT_NEAR(weights_at(picture, place, place, level, wrap)[0], 32768 / 65535.0, 1e-5);
}

}  // namespace
}  // namespace metamer
