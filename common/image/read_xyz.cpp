#include "common/image/read_xyz.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/color/srgb.h"
#include "common/color/xyz.h"
#include "common/image/picture_file.h"
#include "common/image/spectral_exr.h"

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

/// The space of an EXR's chromaticities.
Result<RgbSpace> space_of(const std::vector<float>& c) {
  return make_rgb_space("", "", {{c[0], c[1]}, {c[2], c[3]}, {c[4], c[5]}, {c[6], c[7]}}, {})
      .map_error([](Problem wrong) {
        wrong.message = "its chromaticities make no RGB space: " + wrong.message;
        return wrong;
      });
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

/// RGB → X Y Z as a screen of D65 shows it: the white of the space becomes D65.
Result<Matrix3> as_seen(const RgbSpace& space) {
  return white_for_d65(space).map(
      [&](const Matrix3& white) { return multiply(invert(white), space.to_xyz); });
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

Result<XyzPicture> from_exr(const Image& image, const ImageHeader& header) {
  XyzPicture result;
  if (const auto indices = find_all(image.channels, {"X", "Y", "Z"})) {
    result.image = converted(image, *indices, [](const Xyz& xyz) { return xyz; });
    result.what = "X Y Z";
    return result;
  }
  const auto indices = find_all(image.channels, {"R", "G", "B"});
  if (!indices) {
    std::string names;
    for (std::size_t c = 0; c < std::min<std::size_t>(4, image.channels.size()); ++c)
      names += (c ? ", " : "") + quoted(image.channels[c]);
    return problem("the picture has neither X Y Z nor R G B nor a spectrum; its channels are " +
                   names + (image.channels.size() > 4 ? ", …" : ""));
  }

  // sRGB's own matrix where nothing else is said, so that what `render` writes comes back.
  const bool other = !header.chromaticities.empty() &&
                     !std::equal(srgb_chromaticities.begin(), srgb_chromaticities.end(),
                                 header.chromaticities.begin());
  if (!other) {
    result.image =
        converted(image, *indices, [](const srgb::Rgb& rgb) { return srgb::to_xyz(rgb); });
    result.what = "linear sRGB";
    return result;
  }
  const auto space = space_of(header.chromaticities);
  if (!space) return tl::unexpected<Problem>(space.error());
  const auto to_xyz = as_seen(*space);
  if (!to_xyz) return tl::unexpected<Problem>(to_xyz.error());
  result.image = converted(image, *indices, [&](const Rgb& rgb) { return multiply(*to_xyz, rgb); });
  result.what = "linear RGB of the file's own primaries";
  return result;
}

Result<XyzPicture> from_spectra(const SpectralImage& spectra, const Viewing& viewing) {
  if (spectra.reflectance && viewing.under == nullptr)
    return problem("the picture is a reflectance: it needs a light (--under)");
  if (const auto wrong = wrong_positions(spectra.nm)) return problem(*wrong);
  const Result<ObserverWeights> observer =
      spectra.reflectance
          ? weights_under(viewing.weights, viewing.observer, *viewing.under, spectra.nm)
          : observer_of_bands(viewing.observer, spectra.nm);
  if (!observer) return tl::unexpected<Problem>(observer.error());
  if (spectra.reflectance && to_xyz(*observer, std::vector<double>(spectra.nm.size(), 1.0))[1] == 0)
    return problem("the observer sees nothing of the light");

  XyzPicture result;
  result.image = make_image(spectra.width, spectra.height, {"X", "Y", "Z"});
  std::vector<double> power(spectra.nm.size());
  for (std::size_t i = 0; i < result.image.pixels.size() / 3; ++i) {
    std::copy_n(spectra.values.data() + i * power.size(), power.size(), power.begin());
    const Xyz xyz = to_xyz(*observer, power);
    for (std::size_t c = 0; c < 3; ++c) result.image.pixels[3 * i + c] = static_cast<float>(xyz[c]);
  }
  result.what = std::string(spectra.reflectance ? "a reflectance" : "an emission") + " at " +
                std::to_string(power.size()) + (power.size() == 1 ? " wavelength" : " wavelengths");
  if (spectra.polarised) result.what += ", its polarisation left aside";
  result.units = spectra.units;
  result.lit = spectra.reflectance;
  return result;
}

Result<XyzPicture> read(const fs::path& file, const Viewing& viewing) {
  if (format_of(file) == "exr") {
    const auto spectra = read_spectral_exr(file);
    if (!spectra) return tl::unexpected<Problem>(spectra.error());
    if (*spectra) return from_spectra(**spectra, viewing);
  }
  const auto header = read_header(file);
  if (!header) return tl::unexpected<Problem>(header.error());
  const auto image = read_image(file);
  if (!image) return tl::unexpected<Problem>(image.error());
  return format_of(file) == "png" ? from_png(*image, *header) : from_exr(*image, *header);
}

}  // namespace

Result<XyzPicture> read_xyz(const fs::path& file, const Viewing& viewing) {
  Result<XyzPicture> result = read(file, viewing);
  if (!result) return file_problem(file, result.error().message);
  return result;
}

}  // namespace metamer
