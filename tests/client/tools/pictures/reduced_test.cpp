#include "client/tools/pictures/reduced.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "client/tools/pictures/screen_pixels.h"

namespace metamer::client {
namespace {

Image counted(int width, int height) {
  Image image = make_image(width, height, {"X", "Y", "Z"});
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(i);
  return image;
}

TEST(Reduced, IsTheMeanOfWhatThereIs) {
  const Image image = counted(7, 5);
  for (const PixelArea& area :
       {PixelArea{0, 0, 7, 5}, PixelArea{2, 1, 5, 3}, PixelArea{6, 4, 1, 1}})
    for (const int side : {1, 2, 4, 8}) {
      const Image means = reduced(image, area, side);
      ASSERT_EQ(means.width, (area.width + side - 1) / side);
      ASSERT_EQ(means.height, (area.height + side - 1) / side);
      for (int y = 0; y < means.height; ++y)
        for (int x = 0; x < means.width; ++x) {
          double sum = 0, count = 0;
          for (int j = y * side; j < std::min(area.height, (y + 1) * side); ++j)
            for (int i = x * side; i < std::min(area.width, (x + 1) * side); ++i, ++count)
              sum += image.at(area.x + i, area.y + j)[1];
          EXPECT_NEAR(means.at(x, y)[1], sum / count, 1e-4);
        }
    }
}

TEST(Reduced, SamplesAreTheUpperLeftPixels) {
  const Image image = counted(7, 5);
  const Image samples = sampled(image, 3);
  ASSERT_EQ(samples.width, 3);
  ASSERT_EQ(samples.height, 2);
  EXPECT_EQ(samples.at(2, 1)[2], image.at(6, 3)[2]);
}

TEST(ScreenPixels, FindsEachPixelThatClippingChangesOnce) {
  // Three runs; every 5th is too bright, every 7th too colourful, one is no number.
  Image image = make_image(600, 1, {"X", "Y", "Z"});
  std::size_t expected = 0;
  for (int x = 0; x < 600; ++x) {
    float* xyz = image.at(x, 0);
    xyz[0] = 0.4F, xyz[1] = x % 5 == 0 ? 3.0F : 0.4F, xyz[2] = x % 7 == 0 ? -0.5F : 0.4F;
    if (x == 599) xyz[1] = std::numeric_limits<float>::quiet_NaN();
    expected += x % 5 == 0 || x % 7 == 0 || x == 599;
  }
  std::vector<std::uint8_t> lost(600);
  const ScreenPixels pixels{Developing{}};
  EXPECT_EQ(pixels.find_lost(image.pixels.data(), 600, 1, lost.data()), expected);
  EXPECT_EQ(pixels.find_lost(image.pixels.data(), 600, 1, nullptr), expected);
  for (int x = 0; x < 600; ++x)
    EXPECT_EQ(lost[static_cast<std::size_t>(x)] != 0, x % 5 == 0 || x % 7 == 0 || x == 599) << x;
}

}  // namespace
}  // namespace metamer::client
