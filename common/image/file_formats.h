#pragma once

#include "common/image/compare.h"
#include "common/image/spectral_exr.h"

namespace metamer {

/// What needs OpenImageIO, whose 260 libraries take a third of a second to load: a module beside
/// the programs, metamer-file-formats.so, which is loaded when the first of these functions is
/// called.
struct FileFormats {
  decltype(&metamer::write_image) write_image;
  decltype(&metamer::write_rgb) write_rgb;
  decltype(&metamer::read_header) read_header;
  decltype(&metamer::read_image) read_image;
  decltype(&metamer::write_spectral_exr) write_spectral_exr;
  decltype(&metamer::read_spectral_exr) read_spectral_exr;
  decltype(&metamer::false_color) false_color;
};

}  // namespace metamer

/// The module's one symbol. Once, from any thread.
extern "C" const metamer::FileFormats* metamer_file_formats();
