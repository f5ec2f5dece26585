#include "common/image/pixel_spectrum.h"

#include <algorithm>
#include <charconv>

#include "common/image/picture_file.h"
#include "common/image/spectral_exr.h"

namespace metamer {
namespace {

/// Takes "10x20" off the front of a text.
bool take_pixel(std::string_view& text, int& x, int& y) {
  for (int* const number : {&x, &y}) {
    if (number == &y) {
      if (!text.starts_with('x')) return false;
      text.remove_prefix(1);
    }
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), *number);
    if (error != std::errc() || *number < 0) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  return true;
}

std::optional<PixelWindow> rectangle_of(std::string_view text) {
  PixelWindow found;
  if (!take_pixel(text, found.x0, found.y0)) return std::nullopt;
  if (text.empty()) return PixelWindow{found.x0, found.y0, found.x0, found.y0};
  if (!text.starts_with('-')) return std::nullopt;
  text.remove_prefix(1);
  if (!take_pixel(text, found.x1, found.y1) || !text.empty()) return std::nullopt;
  const auto [left, right] = std::minmax(found.x0, found.x1);
  const auto [top, bottom] = std::minmax(found.y0, found.y1);
  return PixelWindow{left, top, right, bottom};
}

std::vector<double> mean_of(const SpectralImage& image) {
  std::vector<double> mean(image.nm.size());
  for (std::size_t i = 0; i < image.values.size(); ++i)
    mean[i % mean.size()] += static_cast<double>(image.values[i]);
  const double count = static_cast<double>(image.width) * static_cast<double>(image.height);
  for (double& value : mean) value /= count;
  return mean;
}

/// The first spectra of a picture; null where it has none.
const ExrLayer* find_spectra(const std::vector<ExrLayer>& layers) {
  const auto found = std::find_if(layers.begin(), layers.end(), [](const ExrLayer& layer) {
    return layer.kind == ExrLayer::Kind::spectral;
  });
  return found == layers.end() ? nullptr : &*found;
}

}  // namespace

bool is_picture_of_spectra(const std::string& file) { return format_of(file) == "exr"; }

Result<SpectrumFile> read_pixel_spectrum(const PictureSource& source,
                                         const std::optional<std::string>& entry) {
  const auto where = entry ? rectangle_of(*entry) : std::nullopt;
  if (!where)
    return file_problem(
        source.name,
        "is a picture: an entry names a pixel, as \"10x20\" does, or a rectangle to "
        "take the mean of, as \"10x20-30x40\" does");
  const auto parts = read_exr_parts(source);
  if (!parts) return tl::unexpected(parts.error());
  const std::vector<ExrLayer> layers = find_layers(*parts);
  const ExrLayer* const spectra = find_spectra(layers);
  if (spectra == nullptr) return file_problem(source.name, "has no spectra");
  const PixelWindow& all = (*parts)[spectra->part].display;
  if (where->x1 >= all.width() || where->y1 >= all.height())
    return file_problem(source.name, "has no pixel there: it has " + std::to_string(all.width()) +
                                         " by " + std::to_string(all.height()));
  const auto image = read_spectral_layer(source, *parts, *spectra, where);
  if (!image) return tl::unexpected(image.error());
  auto spectrum = make_spectrum(image->nm, mean_of(*image));
  if (!spectrum) return file_problem(source.name, spectrum.error().message);
  SpectrumFile result{.format = "a spectral EXR",
                      .quantity = image->reflectance ? Quantity::reflectance : Quantity::emission,
                      .scale = Scale::one};
  result.spectra.push_back({.name = *entry, .spectrum = std::move(*spectrum)});
  return result;
}

}  // namespace metamer
