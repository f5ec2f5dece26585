#include "server/scene/map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/scene/picture_file.h"

namespace metamer {
namespace {

using Weights = std::vector<std::uint16_t>;

std::uint16_t stored(double weight) {
  return static_cast<std::uint16_t>(std::lround(65535 * weight));
}

/// One map on its way from bytes to numbers.
class MapReader {
 public:
  MapReader(const v1::Texture& picture, PictureUse use, const std::string& field)
      : picture_(picture), use_(use), file_(picture.file(), field) {}

  Result<TexturePicture> read(const std::string& bytes) {
    const auto pixels =
        file_.read(bytes, PngSamples::colors,
                   [&](const std::vector<std::string>& known) { return channels(known); });
    if (!pixels) return tl::unexpected(pixels.error());
    const auto channels = static_cast<std::uint32_t>(pixels->places.size());
    if (auto fits = file_.check_size(pixels->image.width, pixels->image.height, channels); !fits)
      return tl::unexpected(fits.error());
    auto weights = use_ == PictureUse::heights ? heights(*pixels)
                                               : numbers(*pixels, use_ == PictureUse::normals);
    if (!weights) return tl::unexpected(std::move(weights.error()));
    TexturePicture picture = with_levels(static_cast<std::uint32_t>(pixels->image.width),
                                         static_cast<std::uint32_t>(pixels->image.height), channels,
                                         *std::move(weights));
    picture.span = span_;
    return picture;
  }

 private:
  Result<std::vector<std::string>> channels(const std::vector<std::string>& known) const {
    if (use_ == PictureUse::normals) {
      for (const char* name : {"R", "G", "B"})
        if (std::find(known.begin(), known.end(), name) == known.end())
          return file_.at(".file",
                          std::string("a normal map needs R, G and B: the file has no ") + name);
      return std::vector<std::string>{"R", "G", "B"};
    }
    if (picture_.channel_size() > 0) {
      if (auto there = file_.check_channel(picture_.channel(0), known, ".channel"); !there)
        return tl::unexpected(std::move(there.error()));
      return std::vector<std::string>{picture_.channel(0)};
    }
    if (std::find(known.begin(), known.end(), "A") != known.end())
      return std::vector<std::string>{"A"};
    if (known.size() != 1) return file_.wrong_channels(known, 1);
    return known;
  }

  tl::unexpected<Problem> wrong_value(const PictureFile::Pixels& of, std::size_t pixel,
                                      std::size_t channel, const char* meant) const {
    const Image& image = of.image;
    return file_.at_pixel(image, pixel,
                          "channel " + image.channels[channel] + " is " +
                              number_text(image.pixels[pixel * image.channels.size() + channel]) +
                              "; " + meant);
  }

  /// 0 to 1, of normals as x from −1 on.
  Result<Weights> numbers(const PictureFile::Pixels& of, bool normals) const {
    const std::size_t stride = of.image.channels.size(), count = of.image.pixels.size() / stride;
    const double largest = of.bits == 8 ? 255 : of.bits == 16 ? 65535 : 0;
    Weights weights;
    weights.reserve(count * of.places.size());
    for (std::size_t i = 0; i < count; ++i)
      for (const std::size_t c : of.places) {
        const double value = double{of.image.pixels[i * stride + c]};
        if (!(value >= 0 && value <= 1)) return wrong_value(of, i, c, "it must be 0 to 1");
        if (!normals) {
          weights.push_back(stored(value));
          continue;
        }
        const double middle = (largest + 1) / 2;
        const double x =
            largest > 0 ? (std::round(value * largest) - middle) / (middle - 1) : 2 * value - 1;
        weights.push_back(
            static_cast<std::uint16_t>(32768 + std::lround(32767 * std::max(x, -1.0))));
      }
    return weights;
  }

  Result<Weights> heights(const PictureFile::Pixels& of) {
    const std::size_t stride = of.image.channels.size(), count = of.image.pixels.size() / stride;
    const std::size_t channel = of.places.front();
    float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
    for (std::size_t i = 0; i < count; ++i) {
      const float value = of.image.pixels[i * stride + channel];
      if (!(std::abs(value) <= largest_height))
        return wrong_value(of, i, channel, "a height must be -1e6 to 1e6");
      low = std::min(low, value);
      high = std::max(high, value);
    }
    span_ = high - low;
    Weights weights;
    weights.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
      weights.push_back(
          span_ > 0 ? stored(double{of.image.pixels[i * stride + channel] - low} / double{span_})
                    : std::uint16_t{0});
    return weights;
  }

  static constexpr float largest_height = 1e6f;

  const v1::Texture& picture_;
  PictureUse use_;
  PictureFile file_;
  float span_ = 1;
};

}  // namespace

v1::Texture picture_of(const v1::Map& map) {
  v1::Texture picture;
  picture.set_file(map.file());
  if (!map.channel().empty()) picture.add_channel(map.channel());
  picture.set_wrap(map.wrap());
  if (map.has_scale()) *picture.mutable_scale() = map.scale();
  if (map.has_offset()) *picture.mutable_offset() = map.offset();
  picture.set_rotation(map.rotation());
  return picture;
}

Result<TexturePicture> read_map(const v1::Texture& picture, PictureUse use,
                                const std::string& field, const std::string& bytes) {
  return MapReader(picture, use, field).read(bytes);
}

float alpha_at(const RenderMap& map, float u, float v, float level) {
  constexpr float nearly = 1e-5f;
  const auto [s, t] = map.placed.at(u, v);
  float alpha = 0;
  add_weights(map.placed.picture, map.placed.wrap, s, t, map.cutoff ? 0 : level, &alpha);
  if (map.cutoff) return alpha >= *map.cutoff - nearly ? 1 : 0;
  return alpha <= nearly ? 0 : alpha >= 1 - nearly ? 1 : alpha;
}

}  // namespace metamer
