#include <algorithm>
#include <array>
#include <cassert>
#include <span>

#include "common/color/eight_bit.h"
#include "common/image/icc.h"
#include "common/image/image.h"
#include "common/image/picture_file.h"
#include "common/image/whole_file.h"
#include "common/image/write_exr.h"
#include "common/image/write_png.h"

namespace metamer {
namespace {

using Bytes = std::vector<unsigned char>;

/// How many pixels have a value that is `lost`; in blocks, without a branch.
template <class Lost>
std::size_t count_pixels(std::span<const float> rgb, const Lost& lost) {
  constexpr std::size_t block = 3 * 128;
  std::array<unsigned char, block> is_lost;
  std::size_t count = 0;
  for (; !rgb.empty(); rgb = rgb.subspan(std::min(block, rgb.size()))) {
    const std::size_t values = std::min(block, rgb.size());
    for (std::size_t i = 0; i < values; ++i) is_lost[i] = lost(rgb[i]);
    for (std::size_t i = 0; i < values; i += 3)
      count += static_cast<std::size_t>(is_lost[i] | is_lost[i + 1] | is_lost[i + 2]);
  }
  return count;
}

/// Counts what clipping loses, beyond what rounding does, and fills in a row.
void to_8_bit(const std::vector<float>& rgb, const EightBit& codes, unsigned char* bytes,
              GamutReport& gamut) {
  codes(rgb, bytes);
  gamut.negative += count_pixels(rgb, [&](float value) { return codes.is_below(value); });
  gamut.above += count_pixels(rgb, [&](float value) { return codes.is_above(value); });
}

/// The same by 16 bits, which are asked for rarely: a power for each value.
void to_16_bit(const std::vector<float>& rgb, const Transfer& transfer, unsigned char* bytes,
               GamutReport& gamut) {
  constexpr double top = 65535;
  for (std::size_t i = 0; i < rgb.size(); i += 3) {
    bool negative = false, above = false;
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = top * encode(transfer, static_cast<double>(rgb[i + c]));
      negative = negative || !(value > -0.5);
      above = above || value >= top + 0.5;
      const auto code = static_cast<unsigned>(value > 0 ? std::min(value, top) + 0.5 : 0);
      *bytes++ = static_cast<unsigned char>(code >> 8);
      *bytes++ = static_cast<unsigned char>(code & 0xFF);
    }
    gamut.negative += negative ? 1 : 0;
    gamut.above += above ? 1 : 0;
  }
}

/// Says what a .png's numbers mean: sRGB by its name, another space by a profile.
PngDescription describe_png(int width, int height, const Developing& developing,
                            std::map<std::string, std::string> texts) {
  const RgbSpace& space = developing.space;
  texts["metamer:rgb_space"] = space.name + (developing.linear ? ", linear" : "");
  const bool srgb = space.word == "srgb" && !developing.linear;
  return {.width = width,
          .height = height,
          .bits = developing.bits,
          .icc_profile = srgb ? std::string() : icc_profile(space, developing.linear),
          .texts = std::move(texts)};
}

/// What an .exr's numbers mean, by the chromaticities of primaries and white.
std::array<float, 8> chromaticities(const RgbSpace& space) {
  std::array<float, 8> values{};
  std::size_t i = 0;
  for (const Chromaticity& c :
       {space.primaries.red, space.primaries.green, space.primaries.blue, space.primaries.white}) {
    values[i++] = static_cast<float>(c.x);
    values[i++] = static_cast<float>(c.y);
  }
  return values;
}

Result<Bytes> encode_as_png(const Image& xyz, const std::map<std::string, std::string>& metadata,
                            const Developing& developing, GamutReport& gamut) {
  const Matrix3 matrix = multiply(developing.space.from_xyz, developing.adaptation);
  const Transfer transfer = developing.linear ? Transfer{} : developing.space.transfer;
  const EightBit codes(transfer);
  std::vector<float> rgb(3 * static_cast<std::size_t>(xyz.width));
  return encode_png(describe_png(xyz.width, xyz.height, developing, metadata),
                    [&](int y, unsigned char* row) {
                      to_linear_rgb(matrix, xyz.at(0, y), rgb.data(), rgb.size() / 3);
                      if (developing.bits == 16)
                        to_16_bit(rgb, transfer, row, gamut);
                      else
                        to_8_bit(rgb, codes, row, gamut);
                    });
}

Result<Bytes> encode_as_exr(const Image& image, bool xyz,
                            const std::map<std::string, std::string>& metadata,
                            const Developing& developing) {
  ExrDescription description{
      .width = image.width,
      .height = image.height,
      .channels = xyz ? image.channels : std::vector<std::string>{"R", "G", "B"},
      .chromaticities = {},
      .numbers = {},
      .texts = metadata};
  if (!xyz) description.chromaticities = chromaticities(developing.space);
  const Matrix3 matrix = multiply(developing.space.from_xyz, developing.adaptation);
  return encode_exr(description, [&](int y, int end, float* values) {
    const auto pixels = static_cast<std::size_t>(end - y) * static_cast<std::size_t>(image.width);
    if (xyz)
      std::copy_n(image.at(0, y), 3 * pixels, values);
    else
      to_linear_rgb(matrix, image.at(0, y), values, pixels);
  });
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
      (format == "png" ? encode_as_png(xyz_image, metadata, developing, gamut)
                       : encode_as_exr(xyz_image, xyz, metadata, developing))
          .and_then([&](const Bytes& bytes) { return write_whole_file(file, bytes); });
  if (!done) return file_problem(file, done.error().message);
  return gamut;
}

Result<void> write_rgb(int width, int height, std::span<const std::uint8_t> rgb,
                       const std::filesystem::path& file, const Developing& developing) {
  if (format_of(file) != "png") return file_problem(file, "8-bit colours are written as .png");
  const std::size_t row = 3 * static_cast<std::size_t>(width);
  const auto done =
      encode_png(describe_png(width, height, developing, {}), [&](int y, unsigned char* to) {
        std::copy_n(rgb.data() + static_cast<std::size_t>(y) * row, row, to);
      }).and_then([&](const Bytes& bytes) { return write_whole_file(file, bytes); });
  if (!done) return file_problem(file, done.error().message);
  return {};
}

}  // namespace metamer
