// PNG files of all kinds: their samples.
#include "common/image/read_png.h"

#include <cmath>

#include "image_file.h"
#include "png_file.h"

namespace metamer {
namespace {

namespace fs = std::filesystem;
using PngSamples = ImageFile;

/// The samples as stored, times 255.
std::vector<int> samples(const fs::path& file) {
  const auto png = read_png(file);
  if (!png) return {};
  std::vector<int> codes;
  for (const float value : png->image.pixels)
    codes.push_back(static_cast<int>(std::lround(value * 255)));
  return codes;
}

TEST_F(PngSamples, OfAnyDepthAndKindHasItsSamples) {
  const fs::path file = folder_ / "a.png";
  const auto of = [&](const TestPng& test) {
    write_test_png(file, test);
    return samples(file);
  };
  // Grey of fewer bits reaches from 0 to 255 all the same.
  EXPECT_EQ(of({.width = 8, .color_type = PNG_COLOR_TYPE_GRAY, .bits = 1, .bytes = {0b01001000}}),
            (std::vector<int>{0, 255, 0, 0, 255, 0, 0, 0}));
  EXPECT_EQ(of({.width = 4, .color_type = PNG_COLOR_TYPE_GRAY, .bits = 2, .bytes = {0b00011011}}),
            (std::vector<int>{0, 85, 170, 255}));
  EXPECT_EQ(of({.width = 2, .color_type = PNG_COLOR_TYPE_GRAY, .bits = 4, .bytes = {0x3F}}),
            (std::vector<int>{51, 255}));
  EXPECT_EQ(of({.color_type = PNG_COLOR_TYPE_GRAY, .bits = 16, .bytes = {0x80, 0x80}}),
            std::vector<int>{128});
  EXPECT_EQ(of({.color_type = PNG_COLOR_TYPE_GRAY_ALPHA, .bytes = {10, 20}}),
            (std::vector<int>{10, 20}));
  EXPECT_EQ(of({.color_type = PNG_COLOR_TYPE_RGB_ALPHA, .bytes = {1, 2, 3, 4}}),
            (std::vector<int>{1, 2, 3, 4}));
  const std::vector<png_color> palette = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  EXPECT_EQ(of({.width = 2,
                .color_type = PNG_COLOR_TYPE_PALETTE,
                .bits = 4,
                .bytes = {0x20},
                .palette = palette}),
            (std::vector<int>{7, 8, 9, 1, 2, 3}));
  EXPECT_EQ(of({.width = 2,
                .color_type = PNG_COLOR_TYPE_PALETTE,
                .bytes = {0, 1},
                .palette = palette,
                .transparency = "\x40"}),
            (std::vector<int>{1, 2, 3, 64, 4, 5, 6, 255}));
  EXPECT_EQ(of({.width = 2,
                .bytes = {9, 8, 7, 1, 2, 3},
                .transparency = big_endian(9, 2) + big_endian(8, 2) + big_endian(7, 2)}),
            (std::vector<int>{9, 8, 7, 0, 1, 2, 3, 255}));
  // Sixteen bits are kept.
  write_test_png(file, {.bits = 16, .bytes = {0x12, 0x34, 0, 1, 0xFF, 0xFF}});
  const auto deep = read_png(file);
  EXPECT_EQ(deep->bits, 16);
  for (const auto& [i, code] : {std::pair(0u, 0x1234), std::pair(1u, 1), std::pair(2u, 0xFFFF)})
    EXPECT_NEAR(deep->image.pixels[i], code / 65535.0, 1e-7);
  // Interlaced or not, a picture is the same.
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(3, 5), std::pair(17, 9)}) {
    TestPng test{.width = width, .height = height, .bytes = {}};
    for (int i = 0; i < 3 * width * height; ++i)
      test.bytes.push_back(static_cast<unsigned char>(7 * i));
    const std::vector<int> plain = of(test);
    test.interlaced = true;
    EXPECT_EQ(of(test), plain);
    EXPECT_EQ(plain.size(), test.bytes.size());
  }
}

}  // namespace
}  // namespace metamer
