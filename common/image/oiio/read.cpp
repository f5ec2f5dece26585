#include <OpenImageIO/imageio.h>

#include <memory>

#include "common/image/image.h"
#include "common/image/oiio/shared.h"

namespace metamer::oiio {
namespace {

using Input = std::unique_ptr<OIIO::ImageInput>;

/// Opens a picture and checks what its header says: its numbers decide how much memory is taken.
Result<Input> open_picture(const std::filesystem::path& file) {
  if (format_of(file).empty()) {
    return file_problem(
        file, "pictures are read from .png or .exr, not from " + quoted(file.extension().string()));
  }
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return file_problem(file, "no such file");

  Input input = OIIO::ImageInput::open(file.string());
  if (!input) {
    return file_problem(file, "can't read the picture: " + first_line(OIIO::geterror()));
  }
  input->threads(1);
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0 || spec.depth != 1) {
    return file_problem(file, "the picture has no pixels");
  }
  if (spec.image_pixels() > max_image_values / static_cast<std::size_t>(spec.nchannels)) {
    return file_problem(file, "the picture is too large: " + std::to_string(spec.width) + " × " +
                                  std::to_string(spec.height) + " × " +
                                  std::to_string(spec.nchannels) + " values, at most " +
                                  std::to_string(max_image_values));
  }
  return input;
}

}  // namespace

Result<ImageHeader> read_header(const std::filesystem::path& file) {
  const Result<Input> input = open_picture(file);
  if (!input) return tl::unexpected<Problem>(input.error());
  const OIIO::ImageSpec& spec = (*input)->spec();
  ImageHeader header;
  header.width = spec.width;
  header.height = spec.height;
  header.channels = spec.channelnames;
  std::vector<float> chromaticities(8);
  if (spec.getattribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8),
                        chromaticities.data()))
    header.chromaticities = std::move(chromaticities);
  header.emissive_units = spec.get_string_attribute("emissiveUnits");
  header.rgb_space = spec.get_string_attribute("metamer:rgb_space");
  header.has_profile = spec.find_attribute("ICCProfile") != nullptr;
  return header;
}

Result<Image> read_image(const std::filesystem::path& file) {
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
