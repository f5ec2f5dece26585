#include <OpenImageIO/imageio.h>

#include "common/image/file_formats.h"
#include "common/image/oiio/shared.h"

extern "C" __attribute__((visibility("default"))) const metamer::FileFormats*
metamer_file_formats() {
  namespace oiio = metamer::oiio;
  static constexpr metamer::FileFormats functions = {
      oiio::write_image,        oiio::write_rgb,         oiio::read_header, oiio::read_image,
      oiio::write_spectral_exr, oiio::read_spectral_exr, oiio::false_color};
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
  return &functions;
}
