#pragma once

#include <cstring>

#include "server/service/executors/tile_ranges.h"

namespace metamer::service::test {

/// A range as the fake worker renders it: a pixel is (x, y, 1), a tile took 10 rays.
inline RangeResult render(const RangeOrder& order, const TileGrid& grid) {
  RangeResult result;
  result.attempt = order.attempt;
  for (std::uint32_t i = 0; i < order.range.count; ++i) {
    const Rect rect = grid.rect(order.range.first + i);
    RangeResult::Tile& tile = result.tiles.emplace_back();
    tile.rays = 10;
    for (std::uint32_t y = rect.y; y < rect.y + rect.height; ++y)
      for (std::uint32_t x = rect.x; x < rect.x + rect.width; ++x) {
        const float pixel[] = {static_cast<float>(x), static_cast<float>(y), 1};
        tile.xyz.append(reinterpret_cast<const char*>(pixel), sizeof pixel);
      }
  }
  result.digest = digest_of(order, result.tiles);
  return result;
}

}  // namespace metamer::service::test
