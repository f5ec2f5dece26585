#include <OpenImageIO/imageio.h>

#include "common/image/file_formats.h"
#include "common/image/oiio/shared.h"

extern "C" __attribute__((visibility("default"))) const metamer::FileFormats*
metamer_file_formats() {
  namespace oiio = metamer::oiio;
  static constexpr metamer::FileFormats functions = {oiio::read_png_header, oiio::read_png,
                                                     oiio::false_color};
  OIIO::attribute("threads", 1);
  return &functions;
}
