#include "common/image/spectral_exr.h"

#include <algorithm>
#include <cassert>

#include "common/color/srgb.h"
#include "common/image/picture_file.h"
#include "common/image/whole_file.h"
#include "common/image/write_exr.h"
#include "common/spectral/wavelengths.h"

namespace metamer {
namespace {

namespace fs = std::filesystem;
using ChannelKind = SpectralChannel::Kind;

/// R, G, B and then the wavelengths. Error: two wavelengths have one name.
Result<std::vector<std::string>> channel_names(const SpectralImage& image) {
  std::vector<std::string> names = {"R", "G", "B"};
  for (const double nm : image.nm) {
    const std::string name = spectral_channel_name(
        {.kind = image.reflectance ? ChannelKind::reflectance : ChannelKind::emission, .nm = nm});
    if (name == names.back())
      return problem("two wavelengths are too close for the channel name " + quoted(name));
    names.push_back(name);
  }
  return names;
}

ExrDescription describe(const SpectralImage& image, std::vector<std::string> names,
                        const std::map<std::string, std::string>& metadata) {
  ExrDescription description{.width = image.width,
                             .height = image.height,
                             .channels = std::move(names),
                             .chromaticities = srgb_chromaticities,
                             .numbers = {{"EV", 0.0F}},
                             .texts = metadata};
  description.texts["spectralLayoutVersion"] = "1.0";
  if (image.reflectance) return description;
  description.texts["emissiveUnits"] = radiance_units;
  description.texts["metamer:bands"] = band_text;
  description.texts["metamer:unit"] = unit_text;
  return description;
}

/// Rows from y to end: R, G, B, then the spectrum, pixel by pixel.
void interleave(const SpectralImage& image, const Image& preview, int y, int end, float* values) {
  const std::size_t bands = image.nm.size();
  const auto width = static_cast<std::size_t>(image.width);
  const std::size_t first = static_cast<std::size_t>(y) * width;
  const std::size_t count = static_cast<std::size_t>(end - y) * width;
  for (std::size_t i = 0; i < count; ++i) {
    float* const pixel = values + i * (bands + 3);
    to_linear_rgb(srgb::from_xyz_matrix(), preview.pixels.data() + 3 * (first + i), pixel, 1);
    std::copy_n(image.values.data() + (first + i) * bands, bands, pixel + 3);
  }
}

/// A wavelength and where the file keeps it.
struct Band {
  double nm;
  std::size_t channel;
};

/// The channels of a file's spectrum, by rising wavelength, and what they hold.
struct Bands {
  std::vector<Band> bands;
  bool reflectance = false;
  bool polarised = false;
};

Result<void> check_distinct(const std::vector<Band>& bands, const std::vector<std::string>& names) {
  for (std::size_t i = 1; i < bands.size(); ++i)
    if (bands[i].nm == bands[i - 1].nm)
      return problem("channels " + quoted(names[bands[i - 1].channel]) + " and " +
                     quoted(names[bands[i].channel]) + " are both at " + number_text(bands[i].nm) +
                     " nm");
  return {};
}

/// Of channels whose names begin with `prefix` letters of a layer.
Result<Bands> find_bands(const std::vector<std::string>& names, std::size_t prefix) {
  Bands result;
  bool emission = false;
  for (std::size_t c = 0; c < names.size(); ++c) {
    const auto channel = parse_spectral_channel(std::string_view(names[c]).substr(prefix));
    if (!channel) return tl::unexpected<Problem>(channel.error());
    if (!*channel) continue;
    if ((*channel)->kind == ChannelKind::polarisation) {
      result.polarised = true;
      continue;
    }
    emission = emission || (*channel)->kind == ChannelKind::emission;
    result.reflectance = result.reflectance || (*channel)->kind == ChannelKind::reflectance;
    result.bands.push_back({(*channel)->nm, c});
  }
  if (emission && result.reflectance)
    return problem("the picture has an emission (S0.) and a reflectance (T.) as well");
  if (result.polarised && result.bands.empty())
    return problem("the picture has channels S1. to S3., but no S0.");
  if (result.bands.size() > Wavelengths::max_count)
    return problem("the picture has " + std::to_string(result.bands.size()) +
                   " wavelengths, at most " + std::to_string(Wavelengths::max_count) +
                   " are possible");
  std::sort(result.bands.begin(), result.bands.end(),
            [](const Band& a, const Band& b) { return a.nm < b.nm; });
  if (auto distinct = check_distinct(result.bands, names); !distinct)
    return tl::unexpected<Problem>(distinct.error());
  return result;
}

}  // namespace

Result<void> write_spectral_exr(const SpectralImage& image, const Image& preview,
                                const fs::path& file,
                                const std::map<std::string, std::string>& metadata) {
  assert(image.width == preview.width && image.height == preview.height &&
         preview.channels.size() == 3);
  if (format_of(file) != "exr")
    return file_problem(
        file, "spectral pictures are written as .exr, not as " + quoted(file.extension().string()));
  const auto done = channel_names(image)
                        .and_then([&](std::vector<std::string> names) {
                          return encode_exr(describe(image, std::move(names), metadata),
                                            [&](int y, int end, float* values) {
                                              interleave(image, preview, y, end, values);
                                            });
                        })
                        .and_then([&](const std::vector<unsigned char>& bytes) {
                          return write_whole_file(file, bytes);
                        });
  if (!done) return file_problem(file, done.error().message);
  return {};
}

Result<SpectralImage> read_spectral_layer(const PictureSource& source,
                                          const std::vector<ExrPart>& parts, const ExrLayer& layer,
                                          const std::optional<PixelWindow>& only) {
  const std::size_t prefix = layer.layer.empty() ? 0 : layer.layer.size() + 1;
  const Result<Bands> found = find_bands(layer.channels, prefix);
  if (!found) return file_problem(source.name, found.error().message);
  std::vector<std::string> channels;
  for (const Band& band : found->bands) channels.push_back(layer.channels[band.channel]);
  Result<Image> image = read_exr(source, parts, layer.part, channels, only);
  if (!image) return tl::unexpected<Problem>(image.error());

  SpectralImage result;
  result.width = image->width;
  result.height = image->height;
  result.reflectance = found->reflectance;
  result.polarised = found->polarised;
  if (!found->reflectance) result.units = emissive_units(parts[layer.part].emissive_units);
  for (const Band& band : found->bands) result.nm.push_back(band.nm);
  result.values = std::move(image->pixels);
  return result;
}

Result<std::optional<SpectralImage>> read_spectral_exr(const fs::path& file) {
  const auto parts = read_exr_parts(file);
  if (!parts) return tl::unexpected<Problem>(parts.error());
  for (const ExrLayer& layer : find_layers(*parts))
    if (layer.kind == ExrLayer::Kind::spectral) return read_spectral_layer(file, *parts, layer);
  return std::nullopt;
}

}  // namespace metamer
