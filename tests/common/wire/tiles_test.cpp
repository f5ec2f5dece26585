#include "common/wire/tiles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>
#include <utility>
#include <vector>

namespace metamer::wire {

TEST(Tiles, CoverEveryPixelOnce) {
  for (const std::uint32_t width : {1u, 7u, 8u, 64u, 100u, 129u}) {
    for (const std::uint32_t height : {1u, 9u, 48u, 65u}) {
      for (const std::uint32_t size : {8u, 16u, 64u}) {
        const TileGrid grid(width, height, size);
        std::vector<int> times(std::size_t{width} * height);
        for (std::uint32_t i = 0; i < grid.size(); ++i) {
          const Rect rect = grid.rect(i);
          EXPECT_EQ(grid.find(rect), i);
          for (std::uint32_t y = rect.y; y < rect.y + rect.height; ++y) {
            for (std::uint32_t x = rect.x; x < rect.x + rect.width; ++x) {
              ASSERT_LT(x, width);
              ASSERT_LT(y, height);
              ++times[std::size_t{y} * width + x];
            }
          }
        }
        for (const int count : times) ASSERT_EQ(count, 1);
      }
    }
  }
}

TEST(Tiles, BeginAtTheCentreAndGoOutwards) {
  for (const std::uint32_t columns : {1u, 2u, 5u, 40u, 41u}) {
    for (const std::uint32_t rows : {1u, 2u, 7u, 30u, 31u}) {
      const TileGrid grid(columns * 16, rows * 16, 16);
      double last = 0;
      for (std::uint32_t i = 0; i < grid.size(); ++i) {
        const Rect rect = grid.rect(i);
        const double distance =
            std::max(std::abs(rect.x + 8.0 - columns * 8.0), std::abs(rect.y + 8.0 - rows * 8.0));
        EXPECT_GE(distance, last) << columns << " × " << rows << ": " << i;
        last = distance;
      }
    }
  }
  const TileGrid grid(640, 480, 16);
  EXPECT_NEAR(std::hypot(grid.rect(0).x + 8.0 - 320, grid.rect(0).y + 8.0 - 240), 8 * std::sqrt(2),
              1e-9);
}

TEST(Tiles, OfThePicturesThatTakeMostHaveNoTable) {
  static_assert(std::is_trivially_copyable_v<TileGrid>);
  for (const auto& [width, height] : {std::pair(16384u, 16384u), std::pair(16384u, 8u)}) {
    const TileGrid grid(width, height, 8);
    EXPECT_EQ(grid.size(), width / 8 * (height / 8));
    for (std::uint32_t i = 0; i < grid.size(); i += 997) EXPECT_EQ(grid.find(grid.rect(i)), i);
    EXPECT_EQ(grid.find(grid.rect(grid.size() - 1)), grid.size() - 1);
  }
}

TEST(Tiles, KnowWhatIsNone) {
  const TileGrid grid(100, 70, 16);
  EXPECT_FALSE(grid.find({1, 0, 16, 16}));
  EXPECT_FALSE(grid.find({0, 0, 16, 15}));
  EXPECT_FALSE(grid.find({96, 0, 16, 16}));  // the last column is 4 wide
  EXPECT_TRUE(grid.find({96, 0, 4, 16}));
  EXPECT_FALSE(grid.find({112, 0, 16, 16}));
  EXPECT_FALSE(grid.find({0, 4294967280u, 16, 16}));
}

}  // namespace metamer::wire
