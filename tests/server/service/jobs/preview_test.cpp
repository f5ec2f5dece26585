#include "server/service/jobs/preview.h"

#include <gtest/gtest.h>

#include <limits>

namespace metamer::service {

namespace {

/// D65's white in XYZ, which sRGB encodes as 255 255 255.
constexpr float white[] = {0.95047f, 1.0f, 1.08883f};

void fill(Film& film, const Rect& rect, const float (&pixel)[3]) {
  for (std::uint32_t y = rect.y; y < rect.y + rect.height; ++y) {
    for (std::uint32_t x = rect.x; x < rect.x + rect.width; ++x) {
      std::copy(pixel, pixel + 3, film.at(x, y));
    }
  }
}

}  // namespace

TEST(Preview, NoSideIsAboveTheLimitAndASmallPictureKeepsItsPixels) {
  const auto size = [](std::uint32_t width, std::uint32_t height) {
    const v1::Preview preview = PreviewSums(width, height).encode();
    EXPECT_EQ(preview.rgb().size(), std::size_t{preview.width()} * preview.height() * 3);
    return std::pair(preview.width(), preview.height());
  };
  EXPECT_EQ(size(256, 100), std::pair(256u, 100u));
  EXPECT_EQ(size(257, 100), std::pair(129u, 50u));
  EXPECT_EQ(size(16384, 1), std::pair(256u, 1u));
  EXPECT_EQ(size(4096, 16384), std::pair(64u, 256u));
}

TEST(Preview, ABoxIsTheMeanOfItsPixelsThatAreThere) {
  Film film(512, 2);
  PreviewSums preview(512, 2);
  const float half[] = {white[0] / 2, white[1] / 2, white[2] / 2};
  fill(film, {0, 0, 2, 2}, half);
  preview.add(film, {0, 0, 2, 1});  // half of the first box: the mean is not dimmed by the rest
  fill(film, {2, 0, 2, 2}, white);
  preview.add(film, {2, 0, 2, 2});
  const std::string rgb = preview.encode().rgb();
  // Linear 0.5 is 0.7354 encoded: 188 of 255.
  EXPECT_EQ(static_cast<unsigned char>(rgb[0]), 188);
  EXPECT_NEAR(static_cast<unsigned char>(rgb[3]), 255, 1);
  EXPECT_EQ(rgb[6], 0);  // not there yet
}

TEST(Preview, PixelsThatAreNoColoursDoNoHarm) {
  Film film(8, 8);
  PreviewSums preview(8, 8);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  fill(film, {0, 0, 8, 1}, {nan, nan, nan});
  fill(film, {0, 1, 8, 1}, {infinite, infinite, infinite});
  fill(film, {0, 2, 8, 1}, {-1.0f, -1.0f, -1.0f});
  preview.add(film, {0, 0, 8, 8});
  EXPECT_EQ(preview.encode().rgb().substr(0, 3), std::string(3, '\0'));
  EXPECT_EQ(preview.encode().rgb().substr(2 * 8 * 3, 3), std::string(3, '\0'));
}

}  // namespace metamer::service
