// PNGs that are written, read by libpng.

#include "common/image/image.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <random>

namespace metamer {
namespace {

TEST(WritePng, EverySizeAndContentIsReadAsItWas) {
  const auto file =
      std::filesystem::temp_directory_path() / ("write_png_" + std::to_string(::getpid()) + ".png");
  std::mt19937 random(5);
  // Rows that are longer than what is deflated at once, many that are shorter, and single ones.
  const std::pair<int, int> sizes[] = {{1, 1}, {50'000, 3}, {7, 3000}, {640, 70}, {43, 1}};
  for (const auto& [width, height] : sizes)
    for (const unsigned different : {1U, 3U, 256U}) {  // black, a few values, noise
      SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
      std::vector<std::uint8_t> rgb(std::size_t{3} * static_cast<std::size_t>(width) *
                                    static_cast<std::size_t>(height));
      for (std::uint8_t& value : rgb) value = static_cast<std::uint8_t>(random() % different);
      ASSERT_TRUE(write_rgb(width, height, rgb, file, {}));
      const auto back = read_image(file);
      ASSERT_TRUE(back) << back.error().message;
      ASSERT_EQ(back->pixels.size(), rgb.size());
      EXPECT_EQ(back->width, width);
      for (std::size_t i = 0; i < rgb.size(); ++i)
        ASSERT_EQ(std::lround(255 * back->pixels[i]), rgb[i]) << i;
    }
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace metamer
