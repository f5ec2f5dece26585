#include "server/scene/texture.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "common/color/rgb_space.h"
#include "common/image/read_exr.h"
#include "common/image/read_png.h"
#include "common/image/read_png_xyz.h"
#include "common/scene/limits.h"
#include "common/scene/names.h"

namespace metamer {
namespace {

/// What 8 bits can't say better: sums of rounded weights may be above 1 by so much each.
constexpr double rounding = 0.5 / 255;

/// One texture on its way from bytes to weights; errors are located.
class TextureReader {
 public:
  TextureReader(const v1::Texture& texture, const std::string& field)
      : texture_(texture), field_(field) {}

  Result<TexturePicture> read(const std::string& bytes) {
    if (texture_.use() == v1::Texture::RGB) return colors(bytes);
    auto image = has_extension(texture_.file(), ".png") ? png(bytes) : exr(bytes);
    if (!image) return at(".file", std::move(image.error()));
    const auto spectra = static_cast<std::uint32_t>(texture_.spectrum_size());
    if (auto fits = check_size(image->width, image->height, spectra); !fits)
      return tl::unexpected(fits.error());
    auto weights = texture_.use() == v1::Texture::INDEX ? indexed_weights(*image) : blended(*image);
    if (!weights) return tl::unexpected(std::move(weights.error()));
    return with_levels(static_cast<std::uint32_t>(image->width),
                       static_cast<std::uint32_t>(image->height), spectra, *std::move(weights));
  }

 private:
  using Weights = std::vector<std::uint16_t>;

  Result<void> check_size(int width, int height, std::uint32_t weights) const {
    const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    if (pixels <= limits::max_texture_weights / weights) return {};
    return at(".file", "has " + std::to_string(width) + " × " + std::to_string(height) +
                           " pixels of " + std::to_string(weights) + " weights; at most " +
                           std::to_string(limits::max_texture_weights) + " are allowed");
  }

  /// Three weights, those of reflectance_of_rgb().
  Result<TexturePicture> colors(const std::string& bytes) const {
    auto read = read_png_xyz({bytes, texture_.file()});
    if (!read) return at(".file", std::move(read.error()));
    const Image& image = read->image;
    if (auto fits = check_size(image.width, image.height, 3); !fits)
      return tl::unexpected(fits.error());
    const Matrix3& to_rgb = rgb_space(StandardSpace::srgb).from_xyz;
    Weights weights;
    weights.reserve(image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
      const Xyz seen{image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]};
      const Rgb rgb = multiply(to_rgb, seen);
      for (std::size_t c = 0; c < 3; ++c) {
        if (!(rgb[c] >= -rounding && rgb[c] <= 1 + rounding))
          return at_pixel(image, i / 3,
                          std::string("its ") + "RGB"[c] + " of linear sRGB is " +
                              number_text(rgb[c]) + "; a surface has 0 to 1");
        weights.push_back(
            static_cast<std::uint16_t>(std::lround(65535 * std::clamp(rgb[c], 0.0, 1.0))));
      }
    }
    TexturePicture picture =
        with_levels(static_cast<std::uint32_t>(image.width),
                    static_cast<std::uint32_t>(image.height), 3, std::move(weights));
    picture.notes = std::move(read->notes);
    return picture;
  }

  tl::unexpected<Problem> at(const std::string& below, Problem what) const {
    what.field = field_ + below;
    what.file = texture_.file();
    return tl::unexpected(std::move(what));
  }
  tl::unexpected<Problem> at(const std::string& below, std::string message) const {
    return at(below, Problem{.field = {}, .file = {}, .message = std::move(message)});
  }
  tl::unexpected<Problem> at_pixel(const Image& image, std::size_t pixel,
                                   const std::string& what) const {
    const auto width = static_cast<std::size_t>(image.width);
    return at(".file", "pixel " + std::to_string(pixel % width) + ", " +
                           std::to_string(pixel / width) + " (from the upper left): " + what);
  }

  Result<Image> png(const std::string& bytes) const {
    const bool index = texture_.use() == v1::Texture::INDEX;
    return read_png({bytes, texture_.file()}, index ? PngSamples::numbers : PngSamples::colors)
        .map([&](PngPicture&& picture) {
          bits_ = picture.bits;
          return std::move(picture.image);
        });
  }

  /// Of an EXR no channels are read that nobody asks for.
  Result<Image> exr(const std::string& bytes) const {
    const PictureSource source(bytes, texture_.file());
    const auto parts = read_exr_parts(source);
    if (!parts) return tl::unexpected(parts.error());
    std::vector<std::string> channels(texture_.channel().begin(), texture_.channel().end());
    if (channels.empty()) {
      // The alphabet's order, which an EXR has, is nobody's order of spectra.
      if (parts->front().channels.size() > 1)
        return problem("it has " + std::to_string(parts->front().channels.size()) +
                       " channels: name those that are meant in `channel`");
      channels.push_back(parts->front().channels.front().name);
    }
    std::vector<std::string> known;
    for (const ExrChannel& channel : parts->front().channels) known.push_back(channel.name);
    std::set<std::string> named;
    for (const std::string& channel : channels) {
      if (std::find(known.begin(), known.end(), channel) == known.end())
        return tl::unexpected(
            unknown_name("the file has no channel " + quoted(channel), channel, known));
      if (!named.insert(channel).second)
        return problem("channel " + quoted(channel) + " is named twice");
    }
    // Before there is memory taken for it.
    const PixelWindow& display = parts->front().display;
    if (auto fits = check_size(display.width(), display.height(),
                               static_cast<std::uint32_t>(channels.size()));
        !fits)
      return problem(fits.error().message);
    return read_exr(source, *parts, 0, channels);
  }

  /// The places in a pixel of the channels that are meant.
  Result<std::vector<std::size_t>> places(const Image& image) const {
    std::vector<std::size_t> found;
    for (int i = 0; i < texture_.channel_size(); ++i) {
      const auto place =
          std::find(image.channels.begin(), image.channels.end(), texture_.channel(i));
      if (place == image.channels.end())
        return at(".channel[" + std::to_string(i) + "]",
                  unknown_name("the file has no channel " + quoted(texture_.channel(i)),
                               texture_.channel(i), image.channels));
      found.push_back(static_cast<std::size_t>(place - image.channels.begin()));
    }
    if (texture_.channel_size() == 0)
      for (std::size_t i = 0; i < image.channels.size(); ++i) found.push_back(i);
    const auto wanted = texture_.use() == v1::Texture::INDEX
                            ? std::size_t{1}
                            : static_cast<std::size_t>(texture_.spectrum_size());
    if (found.size() == wanted) return found;
    std::string names;
    for (const std::string& name : image.channels) names += (names.empty() ? "" : " ") + name;
    return at(".channel", "the file has " + std::to_string(image.channels.size()) + " channels (" +
                              names + "), " + std::to_string(wanted) +
                              (wanted == 1 ? " is needed" : " are needed") +
                              ": name those that are meant");
  }

  Result<Weights> blended(const Image& image) const {
    const auto channels = places(image);
    if (!channels) return tl::unexpected(channels.error());
    const std::size_t stride = image.channels.size(), pixels = image.pixels.size() / stride;
    const double most = 1 + rounding * static_cast<double>(channels->size());
    Weights weights;
    weights.reserve(pixels * channels->size());
    for (std::size_t i = 0; i < pixels; ++i) {
      double sum = 0;
      for (const std::size_t c : *channels) {
        const float value = image.pixels[i * stride + c];
        if (!(value >= 0 && value <= 1))
          return at_pixel(image, i,
                          "channel " + image.channels[c] + " is " + number_text(value) +
                              "; a weight must be 0 to 1");
        sum += double{value};
      }
      if (!(sum <= most))
        return at_pixel(image, i,
                        "the weights sum to " + number_text(sum) + "; at most 1 is there");
      const double scale = 65535 / std::max(1.0, sum);
      for (const std::size_t c : *channels)
        weights.push_back(
            static_cast<std::uint16_t>(std::lround(scale * double{image.pixels[i * stride + c]})));
    }
    return weights;
  }

  Result<Weights> indexed_weights(const Image& image) const {
    const auto channel = places(image);
    if (!channel) return tl::unexpected(channel.error());
    const std::size_t stride = image.channels.size(), pixels = image.pixels.size() / stride;
    const auto spectra = static_cast<std::size_t>(texture_.spectrum_size());
    const float largest = bits_ == 16 ? 65535.0f : 255.0f;
    Weights weights(pixels * spectra);
    for (std::size_t i = 0; i < pixels; ++i) {
      const auto number = static_cast<std::size_t>(
          std::lround(image.pixels[i * stride + channel->front()] * largest));
      if (number > spectra)
        return at_pixel(image, i,
                        "it is " + std::to_string(number) + ", the number of no spectrum: " +
                            (spectra == 1 ? "there is 1" : "there are " + std::to_string(spectra)));
      if (number > 0) weights[i * spectra + number - 1] = 65535;
    }
    return weights;
  }

  const v1::Texture& texture_;
  const std::string& field_;
  mutable int bits_ = 8;  ///< Of the PNG.
};

}  // namespace

Result<TexturePicture> read_texture(const v1::Texture& texture, const std::string& field,
                                    const std::string& bytes) {
  return TextureReader(texture, field).read(bytes);
}

TextureImport textures_of(const AssetReader& assets) {
  return [assets](const v1::Texture& texture, const std::string& field) -> Result<TexturePicture> {
    const auto bytes = assets(texture.file());
    if (bytes) return read_texture(texture, field, *bytes);
    Problem problem = bytes.error();
    problem.field = field + ".file";
    return tl::unexpected(std::move(problem));
  };
}

std::array<std::array<float, 3>, 2> uv_map(const v1::Texture& texture) {
  const double su = texture.has_scale() ? texture.scale().u() : 1,
               sv = texture.has_scale() ? texture.scale().v() : 1,
               angle = texture.rotation() * std::numbers::pi / 180, c = std::cos(angle),
               s = std::sin(angle);
  const auto row = [](double a, double b, double d) {
    return std::array<float, 3>{static_cast<float>(a), static_cast<float>(b),
                                static_cast<float>(d)};
  };
  return {row(c * su, -s * sv, texture.offset().u()), row(s * su, c * sv, texture.offset().v())};
}

float pixels_per_uv(const TexturePicture& picture, const std::array<std::array<float, 3>, 2>& map) {
  const TexturePicture::Level& finest = picture.levels.front();
  const double area = double{map[0][0]} * map[1][1] - double{map[0][1]} * map[1][0];
  return static_cast<float>(std::sqrt(std::abs(area) * finest.width * finest.height));
}

}  // namespace metamer
