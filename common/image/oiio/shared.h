#pragma once

#include "common/image/compare.h"
#include "common/image/jpeg.h"
#include "common/image/labels.h"

/// What is here uses OpenImageIO; the rest of the project never sees it (file_formats.h). It is
/// kept in the calling thread: who calls decides how many threads there are.
namespace metamer::oiio {

// As compare.h, labels.h and jpeg.h have them.
decltype(metamer::false_color) false_color;
decltype(metamer::draw_labels) draw_labels;
decltype(metamer::decode_jpeg) decode_jpeg;

inline constexpr const char* font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
inline constexpr int letters = label_height;  ///< Their size, in pixels.

/// What OpenImageIO 2.4 can draw: it takes other letters' bytes apart wrongly.
std::string ascii(std::string_view words);

}  // namespace metamer::oiio
