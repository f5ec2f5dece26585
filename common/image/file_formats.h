#pragma once

#include "common/image/compare.h"

namespace metamer {

/// What needs OpenImageIO, whose 260 libraries take a third of a second to load: a module beside
/// the programs, metamer-file-formats.so, which is loaded when the first of these functions is
/// called. All else does without it: PNG and EXR are written, and EXR is read, by their own
/// libraries.
struct FileFormats {
  decltype(&metamer::read_header) read_png_header;
  decltype(&metamer::read_image) read_png;
  decltype(&metamer::false_color) false_color;
};

}  // namespace metamer

/// The module's one symbol. Once, from any thread.
extern "C" const metamer::FileFormats* metamer_file_formats();
