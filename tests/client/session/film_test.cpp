// Tiles become a picture, and nothing that a server sends writes outside it.
#include "client/session/film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/color/srgb.h"

namespace metamer::client {
namespace {

v1::Plan plan_of(std::uint32_t width, std::uint32_t height) {
  v1::Plan plan;
  plan.set_width(width);
  plan.set_height(height);
  return plan;
}

/// Each value of the tile tells its pixel and channel.
v1::Tile tile_at(std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height) {
  v1::Tile tile;
  tile.set_x(x);
  tile.set_y(y);
  tile.set_width(width);
  tile.set_height(height);
  for (std::uint32_t row = y; row < y + height; ++row) {
    for (std::uint32_t column = x; column < x + width; ++column) {
      for (std::uint32_t c = 0; c < 3; ++c) {
        const float value = static_cast<float>(row * 100 + column * 10 + c);
        tile.mutable_xyz()->append(reinterpret_cast<const char*>(&value), sizeof value);
      }
    }
  }
  return tile;
}

TEST(Film, TilesInAnyOrderMakeThePicture) {
  Answer<Film> film = Film::make(plan_of(5, 3));
  ASSERT_TRUE(film);
  EXPECT_EQ(film->missing(), 15u);
  ASSERT_TRUE(film->add(tile_at(3, 0, 2, 2)));
  ASSERT_TRUE(film->add(tile_at(0, 2, 5, 1)));
  EXPECT_FALSE(film->complete());
  ASSERT_TRUE(film->add(tile_at(0, 0, 3, 2)));
  EXPECT_TRUE(film->complete());
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x)
      for (int c = 0; c < 3; ++c)
        EXPECT_EQ(film->image().at(x, y)[c], static_cast<float>(y * 100 + x * 10 + c));
}

TEST(Film, RefusesTilesThatDoNotFit) {
  Answer<Film> film = Film::make(plan_of(5, 3));
  ASSERT_TRUE(film);
  const char* const outside = "the server sent a tile that does not fit the picture";
  EXPECT_EQ(film->add(tile_at(4, 0, 2, 1)).error().message, outside);
  EXPECT_EQ(film->add(tile_at(0, 3, 1, 1)).error().message, outside);

  v1::Tile wrapping = tile_at(0, 0, 1, 1);
  wrapping.set_x(0xffffffffu);
  EXPECT_EQ(film->add(wrapping).error().message, outside);

  v1::Tile empty;
  EXPECT_EQ(film->add(empty).error().message, outside);

  v1::Tile short_one = tile_at(0, 0, 2, 1);
  short_one.mutable_xyz()->pop_back();
  EXPECT_EQ(film->add(short_one).error().message, outside);
  EXPECT_EQ(film->missing(), 15u);
}

TEST(Film, RefusesATileThatCameBefore) {
  Answer<Film> film = Film::make(plan_of(4, 4));
  ASSERT_TRUE(film);
  ASSERT_TRUE(film->add(tile_at(0, 0, 2, 2)));
  EXPECT_EQ(film->add(tile_at(1, 1, 2, 2)).error().message, "the server sent a tile twice");
}

TEST(Film, RefusesSizesThatNoServerPlans) {
  EXPECT_FALSE(Film::make(plan_of(0, 4)));
  EXPECT_FALSE(Film::make(plan_of(20000, 4)));
  EXPECT_FALSE(Film::make(plan_of(16384, 16385)));
}

TEST(Preview, KeepsItsValuesThroughXyz) {
  // Every grey level, and some colours: encoded again they are what they were.
  v1::Preview preview;
  preview.set_width(256);
  preview.set_height(1);
  for (int i = 0; i < 256; ++i) {
    preview.mutable_rgb()->push_back(static_cast<char>(i));
    preview.mutable_rgb()->push_back(static_cast<char>(255 - i));
    preview.mutable_rgb()->push_back(static_cast<char>(i * 7));
  }
  const Answer<Image> image = preview_image(preview);
  ASSERT_TRUE(image);
  for (std::size_t i = 0; i < image->pixels.size(); i += 3) {
    const float* xyz = &image->pixels[i];
    const srgb::Rgb linear = srgb::from_xyz({xyz[0], xyz[1], xyz[2]});
    for (std::size_t c = 0; c < 3; ++c) {
      const double v = std::max(0.0, linear[c]);
      const double encoded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
      EXPECT_EQ(std::lround(encoded * 255), static_cast<unsigned char>(preview.rgb()[i + c])) << i;
    }
  }
}

TEST(Preview, RefusesBytesThatDoNotFit) {
  v1::Preview preview;
  preview.set_width(2);
  preview.set_height(2);
  preview.set_rgb("eleven byte");
  EXPECT_FALSE(preview_image(preview));
}

}  // namespace
}  // namespace metamer::client
