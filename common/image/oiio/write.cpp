#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/color/eight_bit.h"
#include "common/image/icc.h"
#include "common/image/image.h"
#include "common/image/oiio/shared.h"
#include "common/image/whole_file.h"

namespace metamer::oiio {
namespace {

using Bytes = std::vector<unsigned char>;

/// Counts what clipping loses, beyond what rounding to 8 bits does, and gives the bytes.
Bytes to_8_bit(const std::vector<float>& rgb, const EightBit& codes, GamutReport& gamut) {
  Bytes bytes(rgb.size());
  for (std::size_t i = 0; i < rgb.size(); i += 3) {
    bool negative = false, above = false;
    for (std::size_t c = 0; c < 3; ++c) {
      negative = negative || codes.is_below(rgb[i + c]);
      above = above || codes.is_above(rgb[i + c]);
      bytes[i + c] = codes(rgb[i + c]);
    }
    gamut.negative += negative ? 1 : 0;
    gamut.above += above ? 1 : 0;
  }
  return bytes;
}

/// Says what a .png's numbers mean: sRGB by its name, another space by a profile.
void add_png_space(const Developing& developing, OIIO::ImageSpec& spec) {
  const RgbSpace& space = developing.space;
  spec.attribute("metamer:rgb_space", space.name + (developing.linear ? ", linear" : ""));
  if (space.word == "srgb" && !developing.linear) {
    spec.attribute("oiio:ColorSpace", "sRGB");
    return;
  }
  const std::string profile = icc_profile(space, developing.linear);
  spec.attribute("ICCProfile",
                 OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(profile.size())),
                 profile.data());
}

/// And an .exr's: by the chromaticities of primaries and white.
void add_exr_space(const RgbSpace& space, OIIO::ImageSpec& spec) {
  std::vector<float> values;
  for (const Chromaticity& c :
       {space.primaries.red, space.primaries.green, space.primaries.blue, space.primaries.white}) {
    values.push_back(static_cast<float>(c.x));
    values.push_back(static_cast<float>(c.y));
  }
  spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), values.data());
}

OIIO::ImageSpec make_spec(const Image& image, bool png, bool xyz, const Developing& developing,
                          const std::map<std::string, std::string>& metadata) {
  OIIO::ImageSpec spec(image.width, image.height, 3,
                       png ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT);
  spec.channelnames = xyz ? image.channels : std::vector<std::string>{"R", "G", "B"};
  if (png) {
    add_png_space(developing, spec);
  } else {
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", "");  // else the time of writing: the same picture in other bytes
    if (!xyz) add_exr_space(developing.space, spec);
  }
  for (const auto& [name, text] : metadata) spec.attribute(name, text);
  return spec;
}

/// The whole file in memory: a disk that fills up can then be told from a picture that can't be
/// encoded.
Result<Bytes> encode_file(const Image& image, const std::string& format, bool xyz,
                          const std::map<std::string, std::string>& metadata,
                          const Developing& developing, GamutReport& gamut) {
  const bool png = format == "png";
  Bytes bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(format);
  if (!output) return problem("can't write " + format + ": " + first_line(OIIO::geterror()));
  output->threads(1);
  OIIO::ImageSpec spec = make_spec(image, png, xyz, developing, metadata);
  OIIO::Filesystem::IOProxy* proxy = &memory;
  spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  bool good = output->open("memory." + format, spec);

  // Convert and encode a few rows at a time.
  const Matrix3 matrix = multiply(developing.space.from_xyz, developing.adaptation);
  const EightBit codes(developing.linear ? Transfer{} : developing.space.transfer);
  for (int y = 0; good && y < image.height; y += rows_at_a_time) {
    const int end = std::min(image.height, y + rows_at_a_time);
    if (xyz) {
      good = output->write_scanlines(y, end, 0, OIIO::TypeDesc::FLOAT, image.at(0, y));
      continue;
    }
    const auto pixels = static_cast<std::size_t>(end - y) * static_cast<std::size_t>(image.width);
    std::vector<float> rgb(3 * pixels);
    to_linear_rgb(matrix, image.at(0, y), rgb.data(), pixels);
    if (png) {
      const Bytes encoded = to_8_bit(rgb, codes, gamut);
      good = output->write_scanlines(y, end, 0, OIIO::TypeDesc::UINT8, encoded.data());
    } else {
      good = output->write_scanlines(y, end, 0, OIIO::TypeDesc::FLOAT, rgb.data());
    }
  }
  good = good && output->close();
  if (!good) return problem("can't encode the picture: " + first_line(output->geterror()));
  return bytes;
}

}  // namespace

Result<GamutReport> write_image(const Image& xyz_image, const std::filesystem::path& file, bool xyz,
                                const std::map<std::string, std::string>& metadata,
                                const Developing& developing) {
  assert(xyz_image.channels.size() == 3);
  const std::string format = format_of(file);
  if (format.empty()) {
    return file_problem(
        file, "pictures are written as .png or .exr, not as " + quoted(file.extension().string()));
  }
  if (xyz && format == "png") return file_problem(file, "XYZ can only be written as .exr");

  GamutReport gamut;
  const auto done =
      encode_file(xyz_image, format, xyz, metadata, developing, gamut)
          .and_then([&](const Bytes& bytes) { return write_whole_file(file, bytes); });
  if (!done) return file_problem(file, done.error().message);
  return gamut;
}

Result<void> write_rgb(int width, int height, std::span<const std::uint8_t> rgb,
                       const std::filesystem::path& file, const Developing& developing) {
  if (format_of(file) != "png") return file_problem(file, "8-bit colours are written as .png");
  Bytes bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create("png");
  if (!output) return problem("can't write png: " + first_line(OIIO::geterror()));
  output->threads(1);
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  add_png_space(developing, spec);
  OIIO::Filesystem::IOProxy* proxy = &memory;
  spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  const bool good = output->open("memory.png", spec) &&
                    output->write_image(OIIO::TypeDesc::UINT8, rgb.data()) && output->close();
  if (!good) return file_problem(file, first_line(output->geterror()));
  const auto done = write_whole_file(file, bytes);
  if (!done) return file_problem(file, done.error().message);
  return {};
}

}  // namespace metamer::oiio
