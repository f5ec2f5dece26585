#pragma once

#include "common/image/compare.h"
#include "common/image/picture_file.h"

/// What is here uses OpenImageIO; the rest of the project never sees it (file_formats.h). It is
/// kept in the calling thread: who calls decides how many threads there are.
namespace metamer::oiio {

/// As read_header and read_image have them (image.h), of a .png that is there.
Result<ImageHeader> read_png_header(const std::filesystem::path& file);
Result<Image> read_png(const std::filesystem::path& file);
// As compare.h has it.
decltype(metamer::false_color) false_color;

}  // namespace metamer::oiio
