#pragma once

#include <vector>

#include "metamer/v1/worker.pb.h"
#include "server/film/film.h"

namespace metamer::gl {

/// Tiles that the GL backend renders together, as it would take as long for each of them alone.
struct Region {
  Rect rect;                        ///< Around all of them.
  std::vector<v1::TileRect> tiles;  ///< In the daemon's order.
};

/// All tiles in regions of no more than `side` pixels wide and high, as long as no tile is larger;
/// the region of the first tile first.
std::vector<Region> regions_of(const v1::RenderTiles& message, std::uint32_t side);

}  // namespace metamer::gl
