#pragma once

#include "common/wire/tiles.h"

namespace metamer::service {

using wire::Rect;
using wire::TileGrid;
using wire::to_rect;

}  // namespace metamer::service
