#pragma once

#include "common/image/image.h"

namespace metamer::client {

/// Pixels of a picture: the upper left one, and how many.
struct PixelArea {
  int x = 0, y = 0, width = 0, height = 0;
};

/// The means of squares of `side` pixels of an area that lies in the picture, from the area's upper
/// left corner; at its right and lower edge of what there is. `side` >= 1.
Image reduced(const Image& image, const PixelArea& area, int side);

/// One pixel of each such square of the whole picture, its upper left: at once, for a first look.
Image sampled(const Image& image, int side);

}  // namespace metamer::client
