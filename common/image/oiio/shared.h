#pragma once

#include "common/image/compare.h"

/// What is here uses OpenImageIO; the rest of the project never sees it (file_formats.h). It is
/// kept in the calling thread: who calls decides how many threads there are.
namespace metamer::oiio {

// As compare.h has it.
decltype(metamer::false_color) false_color;

}  // namespace metamer::oiio
