#pragma once

#include <string>

#include "common/image/compare.h"
#include "common/image/picture_file.h"
#include "common/image/spectral_exr.h"

/// What is here uses OpenImageIO; the rest of the project never sees it (file_formats.h). It is
/// kept in the calling thread: who calls decides how many threads there are.
namespace metamer::oiio {

// As image.h, spectral_exr.h and compare.h have them.
decltype(metamer::write_image) write_image;
decltype(metamer::write_rgb) write_rgb;
decltype(metamer::read_header) read_header;
decltype(metamer::read_image) read_image;
decltype(metamer::write_spectral_exr) write_spectral_exr;
decltype(metamer::read_spectral_exr) read_spectral_exr;
decltype(metamer::false_color) false_color;

/// Rows that are converted at a time, so that no second picture is held.
inline constexpr int rows_at_a_time = 64;

/// What a library said, fit for one line of a message.
std::string first_line(const std::string& text);

}  // namespace metamer::oiio
