#pragma once

#include "common/image/exr_layers.h"
#include "common/image/read_xyz.h"

namespace metamer {

/// As read_xyz has it, of an .exr that is there.
Result<XyzPicture> read_exr_xyz(const std::filesystem::path& file, const Viewing& viewing,
                                const PictureChoice& choice);

}  // namespace metamer
