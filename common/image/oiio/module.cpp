#include <OpenImageIO/imageio.h>

#include "common/image/file_formats.h"
#include "common/image/oiio/shared.h"

extern "C" __attribute__((visibility("default"))) const metamer::FileFormats*
metamer_file_formats() {
  using namespace metamer::oiio;
  static constexpr metamer::FileFormats functions = {
      write_image,        write_rgb,         read_header, read_image,
      write_spectral_exr, read_spectral_exr, false_color};
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
  return &functions;
}
