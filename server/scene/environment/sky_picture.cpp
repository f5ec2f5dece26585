#include "server/scene/environment/sky_picture.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/color/adaptation.h"
#include "common/color/rgb_space.h"
#include "common/image/exr_layers.h"
#include "common/image/image.h"
#include "common/image/read_exr.h"
#include "common/image/spectral_names.h"
#include "common/scene/findings.h"

namespace metamer {
namespace {

tl::unexpected<Problem> sky_problem(const std::string& name, const std::string& message) {
  return tl::unexpected<Problem>({.field = {}, .file = name, .message = message});
}

/// From the file's R G B to linear sRGB. A neutral stays one, whatever the file's white.
Result<Matrix3> to_srgb(const ExrPart& part) {
  const std::vector<float>& c = part.chromaticities;
  if (c.size() != 8 || std::equal(c.begin(), c.end(), srgb_chromaticities.begin()))
    return identity3;
  const Primaries primaries{{c[0], c[1]}, {c[2], c[3]}, {c[4], c[5]}, {c[6], c[7]}};
  return make_rgb_space("file", "file's RGB", primaries, {})
      .and_then([](const RgbSpace& own) -> Result<Matrix3> {
        const RgbSpace& srgb = rgb_space(StandardSpace::srgb);
        const auto adapted = adaptation_matrix(Adaptation::bradford, white_xyz(own.primaries.white),
                                               white_xyz(srgb.primaries.white));
        if (!adapted) return adapted;
        return multiply(srgb.from_xyz, multiply(*adapted, own.to_xyz));
      });
}

/// Two neighbours that share what lies at a place of a longer row, and the first one's share.
struct Shared {
  std::uint32_t first;
  double share, other;
};
Shared shared_by(std::uint32_t place, std::uint32_t from, std::uint32_t to) {
  const double scale = static_cast<double>(to) / from, begin = place * scale, end = begin + scale;
  const auto first = std::min(static_cast<std::uint32_t>(begin), to - 1);
  const double within = std::min(end, first + 1.0) - begin;
  return {first, within, first + 1 < to ? std::max(0.0, end - (first + 1.0)) : 0.0};
}

tl::unexpected<Problem> wrong_value(float value, std::uint32_t x, std::uint32_t y,
                                    const std::string& name) {
  char text[96];
  std::snprintf(text, sizeof text, "pixel %u, %u is %g; light is 0 or more, and at most 1e30", x, y,
                double{value});
  return sky_problem(name, text);
}

/// Adds up what is read of a larger picture, or of one as large.
class Averaging {
 public:
  Averaging(std::uint32_t width, std::uint32_t height, std::vector<double> nm) : height_(height) {
    to_.nm = std::move(nm);
    // As many values as R G B would have.
    const double side = std::min(1.0, std::sqrt(3.0 / static_cast<double>(to_.parts())));
    to_.width = std::min(width, static_cast<std::uint32_t>(max_sky_width * side));
    to_.height = std::min(height, static_cast<std::uint32_t>(max_sky_height * side));
    to_.values.resize(to_.parts() * to_.width * to_.height);
    for (std::uint32_t x = 0; x < width; ++x) across_.push_back(shared_by(x, width, to_.width));
  }

  /// A row of pixels of so many channels, of which the first is the picture's `channel`. A single
  /// one is grey where `grey` says so.
  Result<void> add(std::uint32_t y, const float* values, std::size_t channels, std::size_t channel,
                   bool grey, const std::string& name) {
    const Shared down = shared_by(y, height_, to_.height);
    for (std::uint32_t x = 0; x < across_.size(); ++x)
      for (std::size_t c = 0; c < channels; ++c) {
        const float value = *values++;
        if (!(value >= 0 && value <= 1e30F)) return wrong_value(value, x, y, name);
        for (std::size_t i = channel + c; i <= (grey ? 2 : channel + c); ++i)
          put(x, down, i, value);
      }
    return {};
  }

  SkyPicture take() { return std::move(to_); }

 private:
  void put(std::uint32_t x, const Shared& down, std::size_t channel, float value) {
    const Shared& across = across_[x];
    const auto add = [&](std::size_t row, double share) {
      float* to = &to_.values[(row * to_.width + across.first) * to_.parts() + channel];
      *to += static_cast<float>(value * share * across.share);
      if (across.other > 0) to[to_.parts()] += static_cast<float>(value * share * across.other);
    };
    add(down.first, down.share);
    if (down.other > 0) add(down.first + 1, down.other);
  }

  std::uint32_t height_;
  std::vector<Shared> across_;  ///< By the picture's own columns.
  SkyPicture to_;
};

/// The channels are R, G and B, one of grey, or those of bands at `nm`. Some rows are read at a
/// time; where all channels at once are more values than may be read at a time, they are read one
/// after the other.
Result<SkyPicture> read_channels(const PictureSource& source, const std::vector<ExrPart>& parts,
                                 const ExrLayer& layer, std::vector<double> nm) {
  const int width = parts[layer.part].display.width(), height = parts[layer.part].display.height();
  Averaging averaging(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height),
                      std::move(nm));
  const std::size_t all = layer.channels.size();
  const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  const std::size_t together = pixels * all <= max_image_values ? all : 1;
  constexpr std::uint64_t values_at_a_time = 8 << 20;
  const int rows_at_a_time = static_cast<int>(std::clamp<std::uint64_t>(
      values_at_a_time / (static_cast<std::uint64_t>(width) * together), 1, 512));
  for (std::size_t first = 0; first < all; first += together) {
    const std::vector<std::string> channels(
        layer.channels.begin() + static_cast<std::ptrdiff_t>(first),
        layer.channels.begin() + static_cast<std::ptrdiff_t>(first + together));
    for (int y = 0; y < height; y += rows_at_a_time) {
      const PixelWindow rows{0, y, width - 1, std::min(y + rows_at_a_time, height) - 1};
      const auto image = read_exr(source, parts, layer.part, channels, rows);
      if (!image) return tl::unexpected<Problem>(image.error());
      for (int row = 0; row < image->height; ++row)
        if (auto good =
                averaging.add(static_cast<std::uint32_t>(y + row), image->at(0, row), together,
                              first, layer.kind == ExrLayer::Kind::grey, source.name.string());
            !good)
          return tl::unexpected<Problem>(good.error());
    }
  }
  return averaging.take();
}

/// In place; what that makes negative is no colour of sRGB and becomes 0: so many pixels.
std::size_t convert(const Matrix3& matrix, SkyPicture& picture) {
  if (matrix == identity3) return 0;
  std::size_t clipped = 0;
  for (std::size_t at = 0; at < picture.values.size(); at += 3) {
    float* pixel = &picture.values[at];
    const Vector3 rgb = multiply(matrix, Vector3{pixel[0], pixel[1], pixel[2]});
    const double least = -1e-6 * double{pixel[0] + pixel[1] + pixel[2]};
    clipped += *std::min_element(rgb.begin(), rgb.end()) < least;
    for (std::size_t i = 0; i < 3; ++i) pixel[i] = static_cast<float>(std::max(0.0, rgb[i]));
  }
  return clipped;
}

/// Leaves a layer its channels of radiance, by rising wavelength, which it returns.
Result<std::vector<double>> sort_bands(ExrLayer& layer, const std::string& name) {
  std::map<double, std::string> bands;
  for (const std::string& channel : layer.channels) {
    const std::size_t begin = layer.layer.empty() ? 0 : layer.layer.size() + 1;
    const auto band = parse_spectral_channel(std::string_view(channel).substr(begin));
    if (!band) return sky_problem(name, band.error().message);
    if (!*band || (*band)->kind == SpectralChannel::Kind::polarisation) continue;
    if ((*band)->kind == SpectralChannel::Kind::reflectance)
      return sky_problem(name, "its spectra are reflectances, no light");
    if (!bands.emplace((*band)->nm, channel).second)
      return sky_problem(name, "two channels are of " + number_text((*band)->nm) + " nm");
  }
  if (bands.empty() || bands.size() > max_sky_bands)
    return sky_problem(name, "an environment has 1 to " + std::to_string(max_sky_bands) +
                                 " bands (it has " + std::to_string(bands.size()) + ")");
  layer.channels.clear();
  std::vector<double> nm;
  for (auto& [at, channel] : bands) {
    nm.push_back(at);
    layer.channels.push_back(std::move(channel));
  }
  return nm;
}

}  // namespace

Result<ReadSky> read_sky_picture(const std::string& bytes, const std::string& name) {
  const PictureSource source(std::string_view(bytes), name);
  const auto parts = read_exr_parts(source);
  if (!parts) return tl::unexpected<Problem>(parts.error());
  const auto chosen = choose_layer(*parts, {});
  if (!chosen) return sky_problem(name, chosen.error().message);
  ExrLayer layer = chosen->layer;
  using Kind = ExrLayer::Kind;
  if (layer.kind == Kind::xyz)
    return sky_problem(name, "an environment is R G B, Y or spectra; this picture is X Y Z");
  auto nm = layer.kind == Kind::spectral ? sort_bands(layer, name) : std::vector<double>();
  if (!nm) return tl::unexpected<Problem>(nm.error());
  const auto matrix =
      layer.kind == Kind::rgb ? to_srgb((*parts)[layer.part]) : Result<Matrix3>(identity3);
  if (!matrix) return sky_problem(name, matrix.error().message);

  auto picture = read_channels(source, *parts, layer, *std::move(nm));
  if (!picture) return tl::unexpected<Problem>(picture.error());
  ReadSky result{std::move(*picture), chosen->notes};
  const PixelWindow& window = (*parts)[layer.part].display;
  if (result.picture.width < static_cast<std::uint32_t>(window.width()) ||
      result.picture.height < static_cast<std::uint32_t>(window.height()))
    result.notes.push_back("averaged from " + std::to_string(window.width()) + " × " +
                           std::to_string(window.height()) + " to " +
                           std::to_string(result.picture.width) + " × " +
                           std::to_string(result.picture.height) + " pixels");
  if (const std::size_t clipped = convert(*matrix, result.picture); clipped > 0)
    result.notes.push_back(std::to_string(clipped) +
                           " pixels are more saturated than sRGB can say: clipped");
  const auto& values = result.picture.values;
  if (std::all_of(values.begin(), values.end(), [](float value) { return value <= 0; }))
    return sky_problem(name, "the picture is black: no light comes from it");
  return result;
}

SkyImport skies_of(const AssetReader& assets) {
  return [assets](const std::string& file) -> Result<std::shared_ptr<const ReadSky>> {
    return assets(file)
        .and_then([&](const std::string& bytes) { return read_sky_picture(bytes, file); })
        .map([](ReadSky&& read) { return std::make_shared<const ReadSky>(std::move(read)); });
  };
}

}  // namespace metamer
