#pragma once

#include "common/image/picture_file.h"
#include "common/image/read_xyz.h"

namespace metamer {

/// As read_xyz has it, of a .png that is there.
Result<XyzPicture> read_png_xyz(const PictureSource& source);

}  // namespace metamer
