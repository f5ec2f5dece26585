#include "common/image/read_exr_xyz.h"

#include <algorithm>

#include "common/color/srgb.h"
#include "common/color/xyz.h"
#include "common/image/alpha.h"
#include "common/image/as_seen.h"
#include "common/image/spectral_exr.h"

namespace metamer {
namespace {

namespace fs = std::filesystem;
using Parts = std::vector<ExrPart>;

/// The space of an EXR's chromaticities.
Result<RgbSpace> space_of(const std::vector<float>& c) {
  return make_rgb_space("", "", {{c[0], c[1]}, {c[2], c[3]}, {c[4], c[5]}, {c[6], c[7]}}, {})
      .map_error([](Problem wrong) {
        wrong.message = "its chromaticities make no RGB space: " + wrong.message;
        return wrong;
      });
}

/// What linear RGB is, and how it becomes X Y Z.
struct LinearSpace {
  Matrix3 to_xyz;
  const char* name;
};

Result<LinearSpace> linear_space(const std::vector<float>& chromaticities) {
  // sRGB's own matrix where nothing else is said, so that what `render` writes comes back.
  const bool other =
      !chromaticities.empty() &&
      !std::equal(srgb_chromaticities.begin(), srgb_chromaticities.end(), chromaticities.begin());
  if (!other) return LinearSpace{srgb::to_xyz_matrix(), "linear sRGB"};
  return space_of(chromaticities).and_then(as_seen).map([](const Matrix3& to_xyz) {
    return LinearSpace{to_xyz, "linear RGB of the file's own primaries"};
  });
}

/// Three values a pixel through a matrix, in place.
void transform(Image& image, const Matrix3& matrix) {
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
    float* const pixel = image.pixels.data() + i;
    const Xyz xyz = multiply(matrix, Vector3{pixel[0], pixel[1], pixel[2]});
    for (std::size_t c = 0; c < 3; ++c) pixel[c] = static_cast<float>(xyz[c]);
  }
  image.channels = {"X", "Y", "Z"};
}

/// Luminance as a grey of the screen's white.
Image from_grey(const Image& grey) {
  Image result = make_image(grey.width, grey.height, {"X", "Y", "Z"});
  const Xyz white = srgb::to_xyz({1, 1, 1});
  for (std::size_t i = 0; i < grey.pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      result.pixels[3 * i + c] = static_cast<float>(white[c] * static_cast<double>(grey.pixels[i]));
  return result;
}

Result<XyzPicture> from_colors(const fs::path& file, const Parts& parts, const ExrLayer& layer) {
  const ExrPart& part = parts[layer.part];
  if (layer.kind == ExrLayer::Kind::grey && !layer.aside.empty())
    return problem("the picture is luminance and chroma (Y, RY, BY), which is not read");
  const auto space = linear_space(part.chromaticities);
  if (layer.kind == ExrLayer::Kind::rgb && !space) return tl::unexpected<Problem>(space.error());
  std::vector<std::string> channels = layer.channels;
  if (!layer.alpha.empty()) channels.push_back(layer.alpha);
  Result<Image> image = read_exr(file, parts, layer.part, channels);
  if (!image) return tl::unexpected<Problem>(image.error());
  XyzPicture result;
  if (!layer.alpha.empty()) result.notes.push_back(alpha_text(take_alpha(*image)));
  switch (layer.kind) {
    case ExrLayer::Kind::xyz:
      result.what = "X Y Z";
      break;
    case ExrLayer::Kind::grey:
      *image = from_grey(*image);
      result.what = "Y";
      result.notes.push_back("its single channel, Y, is taken for the luminance of a grey");
      break;
    case ExrLayer::Kind::rgb:
    case ExrLayer::Kind::spectral:
      transform(*image, space->to_xyz);
      result.what = space->name;
      break;
  }
  result.image = std::move(*image);
  result.image.channels = {"X", "Y", "Z"};
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

std::string window_text(const PixelWindow& window) {
  return "(" + std::to_string(window.x0) + ", " + std::to_string(window.y0) + ") to (" +
         std::to_string(window.x1) + ", " + std::to_string(window.y1) + ")";
}

/// What is to be said of the part that was read.
void add_notes(XyzPicture& picture, const ExrPart& part, const ExrLayer& layer) {
  const PixelWindow &data = part.data, &display = part.display;
  const std::string where = "its data window, " + window_text(data) + ", and its display window, " +
                            window_text(display) + ", differ: ";
  const bool smaller =
      data.x0 > display.x0 || data.y0 > display.y0 || data.x1 < display.x1 || data.y1 < display.y1;
  const bool larger =
      data.x0 < display.x0 || data.y0 < display.y0 || data.x1 > display.x1 || data.y1 > display.y1;
  if (smaller)
    picture.notes.push_back(where + "the display window is the picture, black without data");
  if (larger) picture.notes.push_back(where + "data outside of the display window are left aside");
  if (std::any_of(part.channels.begin(), part.channels.end(), [&](const ExrChannel& channel) {
        return channel.whole_numbers && std::find(layer.channels.begin(), layer.channels.end(),
                                                  channel.name) != layer.channels.end();
      }))
    picture.notes.push_back("its values are whole numbers (uint) and count as they stand");
}

}  // namespace

Result<XyzPicture> read_exr_xyz(const fs::path& file, const Viewing& viewing,
                                const PictureChoice& choice) {
  const auto parts = read_exr_parts(file);
  if (!parts) return tl::unexpected<Problem>(parts.error());
  const auto chosen = choose_layer(*parts, choice);
  if (!chosen) return tl::unexpected<Problem>(chosen.error());
  const ExrLayer& layer = chosen->layer;
  Result<XyzPicture> picture =
      layer.kind == ExrLayer::Kind::spectral
          ? read_spectral_layer(file, *parts, layer).and_then([&](const SpectralImage& spectra) {
              return from_spectra(spectra, viewing);
            })
          : from_colors(file, *parts, layer);
  if (!picture) return picture;
  picture->notes.insert(picture->notes.begin(), chosen->notes.begin(), chosen->notes.end());
  picture->chosen = chosen->by_choice;
  if (const std::string name = name_of(layer, *parts); !name.empty()) picture->what += ", " + name;
  add_notes(*picture, (*parts)[layer.part], layer);
  return picture;
}

}  // namespace metamer
