#pragma once

#include "common/image/picture_file.h"
#include "common/image/read_xyz.h"

namespace metamer {

/// What becomes of a PNG's alpha.
enum class PngAlpha {
  over_black,  ///< Colours are seen over black.
  aside,       ///< They are as they stand, and a note says so.
};

/// As read_xyz has it, of a .png that is there.
Result<XyzPicture> read_png_xyz(const PictureSource& source, PngAlpha use = PngAlpha::over_black);

}  // namespace metamer
