#include "server/gl/regions.h"

#include <gtest/gtest.h>

#include <set>

namespace metamer::gl {
namespace {

/// The tiles of a picture, the last row first.
std::vector<Rect> tiles(std::uint32_t width, std::uint32_t height, std::uint32_t size) {
  std::vector<Rect> all;
  for (std::uint32_t row = (height + size - 1) / size; row-- > 0;)
    for (std::uint32_t x = 0; x < width; x += size)
      all.push_back(
          {x, row * size, std::min(size, width - x), std::min(size, height - row * size)});
  return all;
}

TEST(Regions, HoldEachTileOnceAndAreNoLargerThanTheirSide) {
  for (const std::uint32_t size : {8u, 16u, 24u, 256u}) {
    const std::vector<Rect> all = tiles(1000, 300, size);
    std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
    for (const Region& region : regions_of(all, 256)) {
      EXPECT_LE(region.rect.width, 256u);
      EXPECT_LE(region.rect.height, 256u);
      for (const Rect& tile : region.tiles) {
        EXPECT_TRUE(seen.emplace(tile.x, tile.y).second);
        EXPECT_GE(tile.x, region.rect.x);
        EXPECT_GE(tile.y, region.rect.y);
        EXPECT_LE(tile.x + tile.width, region.rect.x + region.rect.width);
        EXPECT_LE(tile.y + tile.height, region.rect.y + region.rect.height);
      }
    }
    EXPECT_EQ(seen.size(), all.size());
  }
}

TEST(Regions, TheFirstTilesComesFirst) {
  const std::vector<Region> regions = regions_of(tiles(1000, 300, 16), 256);
  EXPECT_EQ(regions.size(), 8u);
  EXPECT_EQ(regions.front().rect.x, 0u);
  EXPECT_EQ(regions.front().rect.y, 256u);
}

TEST(Regions, ATileLargerThanTheirSideIsOneByItself) {
  const std::vector<Region> regions = regions_of(tiles(200, 100, 100), 64);
  ASSERT_EQ(regions.size(), 2u);
  EXPECT_EQ(regions.front().rect.width, 100u);
}

}  // namespace
}  // namespace metamer::gl
