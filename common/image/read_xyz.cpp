#include "common/image/read_xyz.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/color/srgb.h"
#include "common/image/as_seen.h"
#include "common/image/picture_file.h"
#include "common/image/read_exr_xyz.h"

namespace metamer {
namespace {

namespace fs = std::filesystem;
using ChannelIndices = std::array<std::size_t, 3>;

std::optional<std::size_t> find(const std::vector<std::string>& channels, const char* name) {
  const auto found = std::find(channels.begin(), channels.end(), name);
  if (found == channels.end()) return std::nullopt;
  return static_cast<std::size_t>(found - channels.begin());
}

/// Where the three channels are; nothing when one is missing.
std::optional<ChannelIndices> find_all(const std::vector<std::string>& channels,
                                       const std::array<const char*, 3>& names) {
  ChannelIndices indices{};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto index = find(channels, names[c]);
    if (!index) return std::nullopt;
    indices[c] = *index;
  }
  return indices;
}

/// X Y Z of every pixel, by `convert` from the values of three channels.
template <class Convert>
Image converted(const Image& from, const ChannelIndices& indices, const Convert& convert) {
  Image result = make_image(from.width, from.height, {"X", "Y", "Z"});
  const std::size_t channels = from.channels.size(), pixels = result.pixels.size() / 3;
  for (std::size_t i = 0; i < pixels; ++i) {
    const float* pixel = from.pixels.data() + i * channels;
    const Xyz xyz =
        convert(std::array<double, 3>{pixel[indices[0]], pixel[indices[1]], pixel[indices[2]]});
    for (std::size_t c = 0; c < 3; ++c) result.pixels[3 * i + c] = static_cast<float>(xyz[c]);
  }
  return result;
}

/// The space of a .png that render wrote, "Display P3, linear"; nothing where it is another's.
std::optional<std::pair<RgbSpace, Transfer>> written_space(const std::string& name) {
  for (const std::string& word : rgb_space_words()) {
    const RgbSpace& space = *find_rgb_space(word);
    if (name == space.name) return std::pair(space, space.transfer);
    if (name == space.name + ", linear") return std::pair(space, Transfer{});
  }
  return std::nullopt;
}

Result<XyzPicture> from_png(const Image& image, const ImageHeader& header) {
  if (const auto alpha = find(image.channels, "A"))
    for (std::size_t i = *alpha; i < image.pixels.size(); i += image.channels.size())
      if (image.pixels[i] != 1) return problem("the picture has transparent pixels");
  auto indices = find_all(image.channels, {"R", "G", "B"});
  if (!indices) indices = find_all(image.channels, {"Y", "Y", "Y"});
  if (!indices) return problem("the picture is neither grey nor RGB");
  const auto written = written_space(header.rgb_space);
  if (header.has_profile && !written)
    return problem("the picture has an ICC profile of its own: convert it to sRGB first");
  const RgbSpace& space = written ? written->first : srgb::space();
  const Transfer& transfer = written ? written->second : space.transfer;
  const auto to_xyz = as_seen(space);
  if (!to_xyz) return tl::unexpected<Problem>(to_xyz.error());
  XyzPicture result;
  result.image = converted(image, *indices, [&](Rgb value) {
    for (double& one : value) one = decode(transfer, one);
    return multiply(*to_xyz, value);
  });
  result.what = written ? header.rgb_space : space.name;
  return result;
}

Result<XyzPicture> read_png_xyz(const fs::path& file) {
  const auto header = read_header(file);
  if (!header) return tl::unexpected<Problem>(header.error());
  const auto image = read_image(file);
  if (!image) return tl::unexpected<Problem>(image.error());
  return from_png(*image, *header);
}

}  // namespace

Result<XyzPicture> read_xyz(const fs::path& file, const Viewing& viewing,
                            const PictureChoice& choice) {
  if (const auto good = check_readable(file); !good) return tl::unexpected<Problem>(good.error());
  Result<XyzPicture> result =
      format_of(file) == "exr" ? read_exr_xyz(file, viewing, choice) : read_png_xyz(file);
  if (!result) return file_problem(file, result.error().message);
  return result;
}

}  // namespace metamer
