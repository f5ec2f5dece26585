#pragma once

#include <span>
#include <vector>

#include "server/film/film.h"

namespace metamer::gl {

/// Tiles that the GL backend renders together, as it would take as long for each of them alone.
struct Region {
  Rect rect;                ///< Around all of them.
  std::vector<Rect> tiles;  ///< In the order in which they were asked for.
};

/// All tiles in regions of no more than `side` pixels wide and high, as long as no tile is larger;
/// the region of the first tile first.
std::vector<Region> regions_of(std::span<const Rect> tiles, std::uint32_t side);

}  // namespace metamer::gl
