#include <OpenImageIO/imageio.h>

#include "common/image/file_formats.h"
#include "common/image/oiio/shared.h"

extern "C" __attribute__((visibility("default"))) const metamer::FileFormats*
metamer_file_formats() {
  static constexpr metamer::FileFormats functions = {
      metamer::oiio::false_color, metamer::oiio::draw_labels, metamer::oiio::decode_jpeg};
  OIIO::attribute("threads", 1);
  return &functions;
}
