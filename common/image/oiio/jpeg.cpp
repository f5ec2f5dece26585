// JPEGs, from memory.
#include "common/image/jpeg.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "common/image/oiio/shared.h"

namespace metamer::oiio {

Result<RgbBytes> decode_jpeg(std::string_view bytes, std::uint64_t most) {
  OIIO::Filesystem::IOMemReader memory(const_cast<char*>(bytes.data()), bytes.size());
  const auto input = OIIO::ImageInput::open("picture.jpg", nullptr, &memory);
  if (!input) return problem("it can't be read as a JPEG: " + OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || (spec.nchannels != 1 && spec.nchannels != 3))
    return problem("it is a JPEG of " + std::to_string(spec.nchannels) + " channels, not 1 or 3");
  const auto pixels =
      static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(spec.height);
  if (pixels * 3 > most)
    return problem("it is a JPEG of " + std::to_string(spec.width) + " × " +
                   std::to_string(spec.height) + " pixels; at most " + std::to_string(most / 3) +
                   " are read");
  RgbBytes picture{spec.width, spec.height, std::vector<unsigned char>(pixels * 3)};
  // A grey one's value is put where R is, and from there into the other two.
  constexpr OIIO::stride_t pixel = 3;
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, picture.rgb.data(), pixel))
    return problem("it can't be read as a JPEG: " + input->geterror());
  if (spec.nchannels == 1)
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
      picture.rgb[i + 1] = picture.rgb[i + 2] = picture.rgb[i];
  return picture;
}

}  // namespace metamer::oiio
