#include "client/tools/pictures/screen_pixels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "../temporary_folder.h"

namespace metamer::client {
namespace {

/// Colours in and out of gamut, more than a run of them.
Image spread() {
  Image image = make_image(67, 9, {"X", "Y", "Z"});
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<float>(i * 7919 % 1303) / 1000.0F - 0.1F;
  image.pixels[30] = std::numeric_limits<float>::quiet_NaN();
  image.pixels[63] = std::numeric_limits<float>::infinity();
  return image;
}

TEST(ScreenPixels, AreTheNumbersOfTheFile) {
  const TemporaryFolder folder;
  const Image image = spread();
  for (const StandardSpace which : {StandardSpace::srgb, StandardSpace::display_p3})
    for (const bool linear : {false, true}) {
      const Developing developing{.space = rgb_space(which), .linear = linear};
      const std::string file = folder.file("screen.png");
      const auto written = write_image(image, file, false, {}, developing);
      ASSERT_TRUE(written);
      const auto read = read_image(file);
      ASSERT_TRUE(read);
      std::vector<std::uint32_t> screen(image.pixels.size() / 3);
      const GamutReport lost =
          ScreenPixels(developing).develop(image.pixels.data(), screen.size(), 1, screen.data());
      EXPECT_EQ(lost.negative, written->negative);
      EXPECT_EQ(lost.above, written->above);
      for (std::size_t i = 0; i < screen.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
          ASSERT_EQ(screen[i] >> (16 - 8 * c) & 0xffU,
                    static_cast<unsigned>(std::lround(255 * read->pixels[3 * i + c])))
              << i << ", " << c;
    }
}

TEST(ScreenPixels, AStopMoreIsTwiceTheLight) {
  const ScreenPixels srgb{Developing{}};
  const std::vector<float> once{0.2F, 0.25F, 0.125F}, twice{0.4F, 0.5F, 0.25F};
  std::uint32_t exposed = 0, brighter = 0;
  srgb.develop(once.data(), 1, 2, &exposed);
  srgb.develop(twice.data(), 1, 1, &brighter);
  EXPECT_EQ(exposed, brighter);
}

}  // namespace
}  // namespace metamer::client
