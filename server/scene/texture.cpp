#include "server/scene/texture.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "common/color/rgb_space.h"
#include "common/image/read_png_xyz.h"
#include "server/scene/map.h"
#include "server/scene/picture_file.h"

namespace metamer {
namespace {

/// What 8 bits can't say better: sums of rounded weights may be above 1 by so much each.
constexpr double rounding = 0.5 / 255;

/// One texture on its way from bytes to weights.
class TextureReader {
 public:
  TextureReader(const v1::Texture& texture, const std::string& field)
      : texture_(texture), file_(texture.file(), field) {}

  Result<TexturePicture> read(const std::string& bytes) {
    if (texture_.use() == v1::Texture::RGB) return colors(bytes);
    const bool index = texture_.use() == v1::Texture::INDEX;
    const auto pixels =
        file_.read(bytes, index ? PngSamples::numbers : PngSamples::colors,
                   [&](const std::vector<std::string>& known) { return channels(known); });
    if (!pixels) return tl::unexpected(pixels.error());
    const Image& image = pixels->image;
    const auto spectra = static_cast<std::uint32_t>(texture_.spectrum_size());
    if (auto fits = file_.check_size(image.width, image.height, spectra); !fits)
      return tl::unexpected(fits.error());
    auto weights = index ? indexed_weights(*pixels) : blended(*pixels);
    if (!weights) return tl::unexpected(std::move(weights.error()));
    return with_levels(static_cast<std::uint32_t>(image.width),
                       static_cast<std::uint32_t>(image.height), spectra, *std::move(weights));
  }

 private:
  using Weights = std::vector<std::uint16_t>;

  /// Three weights, those of reflectance_of_rgb().
  Result<TexturePicture> colors(const std::string& bytes) const {
    auto read = read_png_xyz({bytes, texture_.file()}, PngAlpha::aside);
    if (!read) return file_.at(".file", std::move(read.error()));
    const Image& image = read->image;
    if (auto fits = file_.check_size(image.width, image.height, 3); !fits)
      return tl::unexpected(fits.error());
    const Matrix3& to_rgb = rgb_space(StandardSpace::srgb).from_xyz;
    Weights weights;
    weights.reserve(image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
      const Xyz seen{image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]};
      const Rgb rgb = multiply(to_rgb, seen);
      for (std::size_t c = 0; c < 3; ++c) {
        if (!(rgb[c] >= -rounding && rgb[c] <= 1 + rounding))
          return file_.at_pixel(image, i / 3,
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

  Result<std::vector<std::string>> channels(const std::vector<std::string>& known) const {
    std::vector<std::string> names(texture_.channel().begin(), texture_.channel().end());
    std::set<std::string> named;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::string& name = names[i];
      const std::string below = ".channel[" + std::to_string(i) + "]";
      if (auto there = file_.check_channel(name, known, below); !there)
        return tl::unexpected(std::move(there.error()));
      if (!file_.is_png() && !named.insert(name).second)
        return file_.at(below, "channel " + quoted(name) + " is named twice");
    }
    // The alphabet's order, which an EXR has, is nobody's order of spectra.
    if (names.empty() && !file_.is_png() && known.size() > 1)
      return file_.at(".file", "it has " + std::to_string(known.size()) +
                                   " channels: name those that are meant in `channel`");
    if (names.empty()) names = known;
    const auto wanted = texture_.use() == v1::Texture::INDEX
                            ? std::size_t{1}
                            : static_cast<std::size_t>(texture_.spectrum_size());
    if (names.size() != wanted) return file_.wrong_channels(known, wanted);
    return names;
  }

  Result<Weights> blended(const PictureFile::Pixels& of) const {
    const Image& image = of.image;
    const std::size_t stride = image.channels.size(), pixels = image.pixels.size() / stride;
    const double most = 1 + rounding * static_cast<double>(of.places.size());
    Weights weights;
    weights.reserve(pixels * of.places.size());
    for (std::size_t i = 0; i < pixels; ++i) {
      double sum = 0;
      for (const std::size_t c : of.places) {
        const float value = image.pixels[i * stride + c];
        if (!(value >= 0 && value <= 1))
          return file_.at_pixel(image, i,
                                "channel " + image.channels[c] + " is " + number_text(value) +
                                    "; a weight must be 0 to 1");
        sum += double{value};
      }
      if (!(sum <= most))
        return file_.at_pixel(image, i,
                              "the weights sum to " + number_text(sum) + "; at most 1 is there");
      const double scale = 65535 / std::max(1.0, sum);
      for (const std::size_t c : of.places)
        weights.push_back(
            static_cast<std::uint16_t>(std::lround(scale * double{image.pixels[i * stride + c]})));
    }
    return weights;
  }

  Result<Weights> indexed_weights(const PictureFile::Pixels& of) const {
    const Image& image = of.image;
    const std::size_t stride = image.channels.size(), pixels = image.pixels.size() / stride;
    const auto spectra = static_cast<std::size_t>(texture_.spectrum_size());
    const float largest = of.bits == 16 ? 65535.0f : 255.0f;
    Weights weights(pixels * spectra);
    for (std::size_t i = 0; i < pixels; ++i) {
      const auto number = static_cast<std::size_t>(
          std::lround(image.pixels[i * stride + of.places.front()] * largest));
      if (number > spectra)
        return file_.at_pixel(
            image, i,
            "it is " + std::to_string(number) + ", the number of no spectrum: " +
                (spectra == 1 ? "there is 1" : "there are " + std::to_string(spectra)));
      if (number > 0) weights[i * spectra + number - 1] = 65535;
    }
    return weights;
  }

  const v1::Texture& texture_;
  PictureFile file_;
};

}  // namespace

Result<TexturePicture> read_texture(const v1::Texture& texture, const std::string& field,
                                    const std::string& bytes) {
  return TextureReader(texture, field).read(bytes);
}

TextureImport textures_of(const AssetReader& assets) {
  return [assets](const v1::Texture& texture, PictureUse use,
                  const std::string& field) -> Result<TexturePicture> {
    const auto bytes = assets(texture.file());
    if (bytes)
      return use == PictureUse::texture ? read_texture(texture, field, *bytes)
                                        : read_map(texture, use, field, *bytes);
    Problem problem = bytes.error();
    problem.field = field + ".file";
    return tl::unexpected(std::move(problem));
  };
}

}  // namespace metamer
