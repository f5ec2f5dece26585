#pragma once

#include "common/image/compare.h"
#include "common/image/jpeg.h"
#include "common/image/labels.h"

namespace metamer {

/// What needs OpenImageIO, whose 260 libraries take half a second to load: a module beside the
/// programs or in ../lib/metamer, metamer-file-formats.so, which is loaded when a function of it is
/// first called. All else does without it: PNG and EXR are written and read by their own libraries.
struct FileFormats {
  decltype(&metamer::false_color) false_color;
  decltype(&metamer::draw_labels) draw_labels;
  decltype(&metamer::decode_jpeg) decode_jpeg;
};

}  // namespace metamer

/// The module's one symbol. Once, from any thread.
extern "C" const metamer::FileFormats* metamer_file_formats();
