#include "server/gl/regions.h"

#include <algorithm>
#include <map>

namespace metamer::gl {
namespace {

Rect around(const Rect& a, const Rect& b) {
  const std::uint32_t x = std::min(a.x, b.x), y = std::min(a.y, b.y);
  return {x, y, std::max(a.x + a.width, b.x + b.width) - x,
          std::max(a.y + a.height, b.y + b.height) - y};
}

}  // namespace

std::vector<Region> regions_of(std::span<const Rect> tiles, std::uint32_t side) {
  std::vector<Region> regions;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> known;  // by cell of the picture
  std::uint32_t tile_side = 1;
  for (const Rect& tile : tiles) tile_side = std::max({tile_side, tile.width, tile.height});
  const std::uint32_t cell = std::max(side / tile_side, 1u) * tile_side;
  for (const Rect& tile : tiles) {
    const auto [place, is_new] = known.try_emplace({tile.x / cell, tile.y / cell}, regions.size());
    if (is_new) regions.push_back({tile, {}});
    Region& region = regions[place->second];
    region.rect = around(region.rect, tile);
    region.tiles.push_back(tile);
  }
  return regions;
}

}  // namespace metamer::gl
