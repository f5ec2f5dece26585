#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <memory>

#include "common/image/image.h"
#include "common/image/oiio/shared.h"

namespace metamer::oiio {
namespace {

using Input = std::unique_ptr<OIIO::ImageInput>;

/// Opens a picture and checks what its header says: its numbers decide how much memory is taken.
Result<Input> open_picture(const std::filesystem::path& file) {
  Input input = OIIO::ImageInput::open(file.string());
  if (!input) {
    return file_problem(file, "can't read the picture: " + first_line(OIIO::geterror()));
  }
  input->threads(1);
  const OIIO::ImageSpec& spec = input->spec();
  const Result<void> good = check_size(file, spec.width, spec.height,
                                       static_cast<std::size_t>(std::max(0, spec.nchannels)));
  if (!good) return tl::unexpected<Problem>(good.error());
  return input;
}

}  // namespace

Result<ImageHeader> read_png_header(const std::filesystem::path& file) {
  const Result<Input> input = open_picture(file);
  if (!input) return tl::unexpected<Problem>(input.error());
  const OIIO::ImageSpec& spec = (*input)->spec();
  ImageHeader header;
  header.width = spec.width;
  header.height = spec.height;
  header.channels = spec.channelnames;
  header.rgb_space = spec.get_string_attribute("metamer:rgb_space");
  header.has_profile = spec.find_attribute("ICCProfile") != nullptr;
  return header;
}

Result<Image> read_png(const std::filesystem::path& file) {
  const Result<Input> input = open_picture(file);
  if (!input) return tl::unexpected<Problem>(input.error());
  const OIIO::ImageSpec& spec = (*input)->spec();
  Image image = make_image(spec.width, spec.height, spec.channelnames);
  if (!(*input)->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.pixels.data())) {
    return file_problem(file, "can't read the picture: " + first_line((*input)->geterror()));
  }
  return image;
}

}  // namespace metamer::oiio
